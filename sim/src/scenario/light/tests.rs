//! Cars that pass, changes, the course of the sun, and what is refused.

use super::*;
use crate::light::illuminance;

fn light(text: &str) -> Light {
    toml::from_str(text).unwrap()
}

fn problem(text: &str) -> Fault {
    light(text).check().unwrap_err()
}

#[test]
fn a_car_passes_and_is_gone() {
    let light = light("cars_at_s = [20.0, 50.0]");
    let brightness = |at: f64| [0, 1, 2, 3].map(|place| light.at(at, &[]).lamps_of(&headlights(place)));
    for dark in [0.0, 20.0, 24.0, 49.9, 54.1] {
        assert_eq!(brightness(dark), [0.0; 4], "{dark} s");
    }
    for after in [20.0, 50.0] {
        assert!(brightness(after + 0.8)[0] > 0.999);
        let [first, second, ..] = brightness(after + 1.2);
        assert!((first - 0.5).abs() < 1e-6 && (second - 0.5).abs() < 1e-6);
        assert!(brightness(after + 3.6)[3] > 0.4);
    }
    assert_eq!(LightState::default().lamps_of(&headlights(0)), 0.0, "no scenario, no car");
}

#[test]
fn a_change_takes_its_time_and_what_is_not_written_stays() {
    let light = light(
        "lamp_brightness = { street = 0.5 }\nsun = { elevation_deg = 10, azimuth_deg = 270 }\n\
         [[timeline]]\nat_s = 10\nover_s = 20\ncloud_cover = 0.8\nsun = { elevation_deg = 0, azimuth_deg = 280 }\n\
         [[timeline]]\nat_s = 40\nlamps = false\n",
    );
    assert_eq!(light.check(), Ok(()));
    let groups = ["street".to_owned(), "tunnel".to_owned()];
    let cover = |at| light.instant(at).cloud_cover;
    assert_eq!([cover(0.0), cover(10.0), cover(20.0), cover(30.0), cover(99.0)], [0.0, 0.0, 0.4, 0.8, 0.8]);
    assert_eq!(light.instant(20.0).sun, Some(Direction { elevation_deg: 5.0, azimuth_deg: 275.0 }));
    assert_eq!(light.at(39.9, &groups).lamps_of("street"), 0.5);
    assert_eq!(light.at(39.9, &groups).lamps_of("tunnel"), 1.0);
    assert_eq!(light.at(40.0, &groups).lamps_of("tunnel"), 0.0);
    let ground = |at| illuminance(&light.at(at, &groups).sky.horizontal());
    assert!(ground(0.0) > ground(30.0) && ground(30.0) > 1.0);
}

#[test]
fn the_sun_runs_its_course_by_place_and_date() {
    let light =
        light("place = { latitude_deg = 51.48, longitude_deg = 0.0 }\ndate = \"2026-06-21\"\ntime_utc = \"12:02\"\n");
    assert_eq!(light.check(), Ok(()));
    let [elevation, azimuth] = light.course(0.0).unwrap().map(f64::to_degrees);
    // Noon at the solstice: 90° − latitude + the ecliptic's obliquity.
    assert!((elevation - (90.0 - 51.48 + 23.44)).abs() < 0.1 && (azimuth - 180.0).abs() < 1.0, "{elevation} {azimuth}");
    assert!(light.course(3600.0).unwrap()[0].to_degrees() < elevation - 2.0);
}

#[test]
fn without_a_sun_it_is_an_overcast_day_of_any_brightness() {
    let [day, night] = [1.0, 0.0].map(|scale| light(&format!("daylight_scale = {scale}")).at(0.0, &[]));
    assert!((illuminance(&day.sky.horizontal()) - 7100.0).abs() < 100.0);
    assert_eq!(day.windows, [1.0; 4]);
    assert_eq!((illuminance(&night.sky.horizontal()), night.windows), (0.0, [0.0; 4]));
}

#[test]
fn what_makes_no_sense_is_said_with_its_place() {
    for (text, key, part) in [
        ("cloud_cover = 1.5", "light.cloud_cover", "0 to 1"),
        ("sun = { elevation_deg = 99, azimuth_deg = 0 }", "light.sun.elevation_deg", "-90 to 90"),
        ("date = \"2026-06-21\"", "light", "latitude_deg"),
        (
            "place = { latitude_deg = 9, longitude_deg = 9 }\ndate = \"2026-02-30\"\ntime_utc = \"10:00\"",
            "light.date",
            "2026-06-21",
        ),
        (
            "place = { latitude_deg = 9, longitude_deg = 9 }\ndate = \"2026-02-20\"\ntime_utc = \"25:00\"",
            "light.time_utc",
            "23:59",
        ),
        ("[[timeline]]\nat_s = 5\n[[timeline]]\nat_s = 4\n", "light.timeline.1.at_s", "order of time"),
        (
            "[[timeline]]\nat_s = 5\nsun = { elevation_deg = 9, azimuth_deg = 0 }\n",
            "light.timeline.0.sun",
            "no sun to move",
        ),
        ("lamp_brightness = { street = -1 }", "light.lamp_brightness.street", "0 to 10"),
    ] {
        let fault = problem(text);
        assert!(fault.key == key && fault.problem.contains(part), "{text}: {fault:?}");
    }
    let groups = ["street".to_owned()];
    let fault = light("lamp_brightness = { stret = 1 }").check_groups(&groups).unwrap_err();
    assert!(fault.problem.contains("did you mean `street`"), "{fault:?}");
}
