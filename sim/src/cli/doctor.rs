//! `sunblind doctor`: what there is to render with.

use std::fmt::Write;
use std::path::Path;

use clap::Args;

use super::{Failure, answer};
use crate::render::Adapter;
use crate::world::bake::cache_folder;

const HELP: &str = "\
Prints the versions, the graphics adapter with its driver, the number of processors and where a world's light is kept once
it is computed; then what is missing and the command that installs it. Without a graphics card Mesa's lavapipe renders on
the processor. Put all of it into a report of a bug: images are only comparable with the driver's version at hand.

Exit code 3 when there is no graphics adapter that works.";

/// The versions that this was built with.
const LOCK: &str = include_str!("../../../Cargo.lock");

/// Show what there is to render with, and what is missing.
#[derive(Args)]
#[command(after_long_help = HELP)]
pub(super) struct Doctor {}

impl Doctor {
    pub fn run(&self) -> Result<(), Failure> {
        let adapter = Adapter::find();
        let processors = std::thread::available_parallelism().map_or_else(|error| error.to_string(), |n| n.to_string());
        let mut rows = vec![
            ("sunblind", env!("CARGO_PKG_VERSION").to_owned()),
            ("wgpu", version_in(LOCK, "wgpu").unwrap_or("unknown").to_owned()),
            ("processors", processors),
            ("kept light", kept(&cache_folder())),
        ];
        if let Ok(Adapter { name, driver, backend }) = &adapter {
            rows.extend([("adapter", name.clone()), ("driver", driver.clone()), ("backend", backend.clone())]);
        }
        answer(&table(&rows));
        let adapter = adapter?;
        answer(advice(&adapter));
        Ok(())
    }
}

fn table(rows: &[(&str, String)]) -> String {
    rows.iter().fold(String::new(), |mut table, (name, value)| {
        writeln!(table, "{name:<12}{value}").expect("a string takes all that is written to it");
        table
    })
}

/// What would be better.
fn advice(adapter: &Adapter) -> &'static str {
    if adapter.backend == "vulkan" {
        "nothing is missing"
    } else {
        "missing: a Vulkan driver; OpenGL ES renders too, more slowly and with slightly other images\n\
         install one: sudo apt-get install mesa-vulkan-drivers libvulkan1"
    }
}

/// Where light is kept, and how much there is.
fn kept(folder: &Path) -> String {
    let sizes = std::fs::read_dir(folder).map(|entries| {
        let sizes = entries.filter_map(|entry| entry.ok()?.metadata().ok()).map(|file| file.len());
        sizes.fold((0, 0), |(count, sum), size| (count + 1, sum + size))
    });
    match sizes {
        Ok((count, bytes)) => format!("{} ({count} files, {:.1} MB)", folder.display(), bytes as f64 / 1e6),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => format!("{} (nothing yet)", folder.display()),
        Err(error) => format!("{} ({error}: light is computed each time)", folder.display()),
    }
}

/// The version of a package in a Cargo.lock.
fn version_in<'a>(lock: &'a str, package: &str) -> Option<&'a str> {
    let mut lines = lock.lines().skip_while(|line| *line != format!("name = \"{package}\""));
    lines.nth(1)?.strip_prefix("version = \"")?.strip_suffix('"')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_version_is_the_packages_own() {
        let lock = "[[package]]\nname = \"wgpu-types\"\nversion = \"1.0.0\"\n\n[[package]]\nname = \"wgpu\"\nversion = \"30.0.1\"\n";
        assert_eq!((version_in(lock, "wgpu"), version_in(lock, "gpu")), (Some("30.0.1"), None));
        assert!(version_in(LOCK, "wgpu").is_some());
    }

    #[test]
    fn only_a_vulkan_driver_wants_nothing() {
        let adapter = |backend: &str| Adapter { name: String::new(), driver: String::new(), backend: backend.into() };
        assert_eq!(advice(&adapter("vulkan")), "nothing is missing");
        assert!(advice(&adapter("gl")).contains("mesa-vulkan-drivers"));
    }
}
