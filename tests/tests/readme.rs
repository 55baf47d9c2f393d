//! Every command in README.md runs as it stands.

use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the project's root")
}

/// The commands in the README's `sh` blocks, in their order, without their comments.
fn commands(readme: &str) -> Vec<String> {
    let blocks = readme.split("```sh\n").skip(1).filter_map(|rest| rest.split("```").next());
    let lines = blocks.flat_map(str::lines).map(|line| line.split(" # ").next().unwrap_or_default().trim().to_owned());
    lines.filter(|line| !line.is_empty()).collect()
}

#[test]
fn every_command_runs() {
    let readme = std::fs::read_to_string(root().join("README.md")).expect("README.md");
    let commands = commands(&readme);
    assert_eq!(commands[..2], ["make demo", "make test"], "the README begins with its two commands");
    // `make test` is what is running this.
    for command in commands.iter().filter(|command| *command != "make test") {
        let output = Command::new("sh").arg("-c").arg(command).current_dir(root()).output().expect("sh runs");
        let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(output.status.success(), "`{command}` ended with {}:\n{text}", output.status);
        println!("{command}\n{text}");
    }
    for report in
        ["out/demo/report.html", "out/again/report.html", "out/fewer/report.html", "out/views/contact_sheet.png"]
    {
        assert!(root().join(report).is_file(), "{report}");
    }
}

#[test]
fn what_the_readme_links_to_exists() {
    let readme = std::fs::read_to_string(root().join("README.md")).expect("README.md");
    let links: Vec<_> = readme.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    assert!(links.len() > 3, "{links:?}");
    for link in links.iter().filter(|link| !link.starts_with("http")) {
        assert!(root().join(link).exists(), "README.md links to {link}");
    }
}
