//! What `sunblind validate` measures, a little less of it, a test a target; the page in the repository has the same
//! targets. `cargo test --release --test kinect targets -- --nocapture` prints what was measured.

use std::fs;
use std::path::Path;

use sunblind_sim::validation::{EXPERIMENTS, Effort, table};

/// The cells of each of the page's rows.
fn page() -> Vec<Vec<String>> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../VALIDATION.md");
    let text = fs::read_to_string(file).expect("`sunblind validate --markdown VALIDATION.md` writes it");
    let rows = text.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
    rows.map(|row| row.split(" | ").map(str::to_owned).collect()).collect()
}

/// A row but for what was measured and whether it held.
fn target_of(row: &[String]) -> Vec<String> {
    let kept = table::HEADER.iter().zip(row).filter(|(name, _)| !["measured", "held"].contains(*name));
    kept.map(|(_, cell)| cell.clone()).collect()
}

fn assert_held(target: &str) {
    let experiment = EXPERIMENTS.iter().find(|experiment| experiment.target == target).expect("a target");
    let page: Vec<_> = page().iter().map(|row| target_of(row)).collect();
    let findings = experiment.run(Effort::Reduced).expect("a graphics adapter");
    let mut missed = Vec::new();
    for finding in &findings {
        let row = table::row(experiment, finding);
        println!("{}", row.join("  "));
        assert!(page.contains(&target_of(&row)), "not in VALIDATION.md: {row:?}; write it anew");
        if !finding.held() {
            missed.push(row.join("  "));
        }
    }
    assert!(missed.is_empty(), "not as it should be:\n{}", missed.join("\n"));
}

macro_rules! targets {
    ($($test:ident: $target:literal,)*) => {
        $(#[test]
        fn $test() {
            assert_held($target);
        })*

        #[test]
        fn no_target_is_left_out() {
            let tested = [$($target),*];
            assert_eq!(tested.to_vec(), EXPERIMENTS.iter().map(|experiment| experiment.target).collect::<Vec<_>>());
        }
    };
}

targets! {
    depth_comes_in_the_published_steps: "V1",
    noise_along_the_view_grows_as_published: "V2",
    grazing_views_are_noisier_and_at_last_blind: "V3",
    edges_jitter_as_published: "V4",
    lamps_without_infrared_leave_depth_as_it_is: "V5",
    darkness_blinds_colour_and_not_depth: "V6",
    shadows_fall_to_the_left_as_wide_as_geometry_says: "V7",
    a_furnished_room_has_as_many_holes_as_a_real_one: "V8",
    a_tile_has_the_published_counts: "V9",
    shade_and_clouds_leave_depth_to_some_metres: "V10",
    full_sun_takes_depth_and_leaves_the_infrared_image: "V11",
    depth_drops_out_within_a_factor_of_sunlight: "V12",
    a_low_sun_blinds_at_few_lux: "V13",
    plants_shine_at_830_nm: "V14",
    distances_drift_for_an_hour: "V15",
    the_robot_turns_as_if_its_wheels_stood_further_apart: "V16",
    images_come_when_they_should: "V17",
}

#[test]
fn the_page_says_that_all_is_held() {
    let rows = page();
    assert_eq!(rows[0], table::HEADER);
    for (experiment, rows) in EXPERIMENTS
        .iter()
        .map(|experiment| (experiment, rows.iter().filter(|row| row[0] == experiment.target).collect::<Vec<_>>()))
    {
        assert!(!rows.is_empty(), "{} is missing", experiment.target);
        assert!(rows.iter().all(|row| row[5] == "yes" && row[6] == experiment.source.name()), "{rows:?}");
    }
}
