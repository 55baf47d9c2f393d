//! The switch by itself, fed with energies over time.

use super::*;
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const LIT: f64 = 0.2;
const DARK: f64 = 0.0002;
const DOTS: f64 = 0.01;
const ROOM: f64 = 0.8;

fn at(seconds: f64) -> Timestamp {
    Timestamp::from_secs(seconds).unwrap()
}

fn auto() -> ModeSwitch {
    ModeSwitch::new(ModeChoice::Auto, SwitchParams::default())
}

/// Energies of colour, infrared and depth.
type Scene<'a> = &'a dyn Fn(f64) -> [f64; 3];

/// A device at 15 Hz; the modes one after the other, each with when it began.
struct Device {
    switch: ModeSwitch,
    now: f64,
    /// Takes 0.2 s to switch between colour and infrared; `None` for one that gives both.
    shows_infrared: Option<(bool, f64)>,
    modes: Vec<(f64, Mode)>,
    frames: [usize; 3],
}

impl Device {
    fn new(exclusive: bool) -> Self {
        let shows_infrared = exclusive.then_some((false, 0.0));
        Self { switch: auto(), now: 0.0, shows_infrared, modes: vec![(0.0, Mode::Indoor)], frames: [0; 3] }
    }

    fn run(&mut self, seconds: f64, scene: Scene) -> &mut Self {
        let end = self.now + seconds;
        while self.now < end {
            self.step(scene);
        }
        self
    }

    fn step(&mut self, scene: Scene) {
        self.now += 1.0 / 15.0;
        let wanted = self.switch.wanted();
        let mut given = [wanted.rgb, wanted.infrared, wanted.depth];
        if let Some((infrared, ready)) = &mut self.shows_infrared {
            let asked = wanted.infrared && !wanted.rgb;
            if *infrared != asked {
                (*infrared, *ready) = (asked, self.now + 0.2);
            }
            let is_ready = self.now >= *ready;
            given = [is_ready && !*infrared && wanted.rgb, is_ready && *infrared, true];
        }
        let energies = scene(self.now);
        // A wheel reading, late enough to notice what is missing.
        self.switch.pass(at(self.now));
        for stream in STREAMS {
            if given[stream as usize] && energies[stream as usize].is_finite() {
                self.switch.see(stream, at(self.now), energies[stream as usize]);
                self.frames[stream as usize] += 1;
            }
        }
        let mode = self.switch.mode();
        if self.modes.last().is_some_and(|(_, last)| *last != mode) {
            self.modes.push((self.now, mode));
        }
    }

    fn sequence(&self) -> Vec<Mode> {
        self.modes.iter().map(|(_, mode)| *mode).collect()
    }
}

fn steady(energies: [f64; 3]) -> impl Fn(f64) -> [f64; 3] {
    move |_| energies
}

#[test]
fn light_goes_out_and_on_again() {
    for exclusive in [false, true] {
        let mut device = Device::new(exclusive);
        device.run(20.0, &steady([LIT, DOTS, ROOM]));
        device.run(20.0, &steady([DARK, DOTS, ROOM]));
        device.run(30.0, &steady([LIT, DOTS, ROOM]));
        assert_eq!(device.sequence(), [Mode::Indoor, Mode::Night, Mode::Indoor], "exclusive: {exclusive}");
        let (dark, light) = (device.modes[1].0 - 20.0, device.modes[2].0 - 40.0);
        assert!(dark < 0.5, "{dark} s");
        // With turns to take, the light is seen at the next look only.
        assert!(light < if exclusive { 18.0 } else { 0.5 }, "{light} s");
    }
}

#[test]
fn a_device_that_takes_turns_is_rarely_asked_for_what_the_mode_does_not_need() {
    let mut device = Device::new(true);
    device.run(60.0, &steady([LIT, DOTS, ROOM]));
    assert_eq!(device.frames[1], 0, "in the light, infrared changes nothing");
    device.run(60.0, &steady([DARK, DOTS, ROOM]));
    let before = device.frames;
    device.run(120.0, &steady([DARK, DOTS, ROOM]));
    let [colour, infrared, _] = [0, 1, 2].map(|stream| device.frames[stream] - before[stream]);
    assert!(colour > 0, "it looks whether there is light again");
    assert!(infrared as f64 > 0.85 * 120.0 * 15.0, "{infrared} infrared images, {colour} colour images");
    assert_eq!(device.sequence(), [Mode::Indoor, Mode::Night]);
}

#[test]
fn one_that_gives_both_is_asked_for_both() {
    let mut device = Device::new(false);
    device.run(2.0, &steady([LIT, DOTS, ROOM])).run(60.0, &steady([DARK, DOTS, ROOM]));
    assert_eq!(device.switch.wanted(), Streams { rgb: true, infrared: true, depth: true });
}

#[test]
fn whoever_is_switched_on_in_the_dark_knows_at_once() {
    for (exclusive, least) in [(false, 1.0 / 15.0), (true, 0.2)] {
        let mut device = Device::new(exclusive);
        device.run(5.0, &steady([DARK, DOTS, ROOM]));
        let [_, (since, Mode::Night)] = device.modes[..] else { panic!("{:?}", device.modes) };
        assert!(since < least + 1e-9, "{since} s");
    }
}

#[test]
fn out_into_the_sun_and_back() {
    for exclusive in [false, true] {
        let mut device = Device::new(exclusive);
        device.run(5.0, &steady([LIT, DOTS, ROOM])).run(60.0, &steady([LIT, 0.05, 0.002]));
        device.run(10.0, &steady([LIT, DOTS, ROOM]));
        assert_eq!(device.sequence(), [Mode::Indoor, Mode::Outdoor, Mode::Indoor], "exclusive: {exclusive}");
        assert!(device.modes[1].0 < 5.5 && device.modes[2].0 < 65.5, "{:?}", device.modes);
    }
}

#[test]
fn what_cannot_be_trusted_leaves_the_wheels() {
    let nothing = f64::NAN;
    for (why, scene) in [
        ("the lens is covered", [DARK, 0.4, 0.0]),
        ("dark, and the projector is off", [DARK, 0.0, 0.0]),
        ("no image comes any more", [nothing; 3]),
        ("no depth, and the device gives no infrared", [LIT, nothing, 0.0]),
    ] {
        for exclusive in [false, true] {
            let mut device = Device::new(exclusive);
            device.run(5.0, &steady([LIT, DOTS, ROOM])).run(30.0, &steady(scene));
            assert_eq!(device.switch.mode(), Mode::Odometer, "{why}; exclusive: {exclusive}, {:?}", device.modes);
            device.run(8.0, &steady([LIT, DOTS, ROOM]));
            assert_eq!(device.switch.mode(), Mode::Indoor, "{why}, and then not; exclusive: {exclusive}");
            device.run(30.0, &steady(scene)).run(8.0, &steady([DARK, DOTS, ROOM]));
            assert_eq!(device.switch.mode(), Mode::Night, "{why}, and then it is night; exclusive: {exclusive}");
        }
    }
}

#[test]
fn what_does_not_last_changes_nothing() {
    let scenes: [(&str, Scene); 4] = [
        ("a flickering lamp", &|t: f64| [if (t * 4.1).fract() < 0.5 { LIT } else { DARK }, DOTS, ROOM]),
        ("a hand before the lens", &|t: f64| {
            if (t - 3.0).rem_euclid(7.0) < 0.15 { [DARK, 0.9, 0.0] } else { [LIT, DOTS, ROOM] }
        }),
        ("sun between leaves", &|t: f64| [LIT, 0.05, if (t - 1.5).rem_euclid(3.0) < 0.15 { 0.002 } else { 0.6 }]),
        ("frames that are lost", &|t: f64| if t.rem_euclid(4.0) < 0.9 { [f64::NAN; 3] } else { [LIT, DOTS, ROOM] }),
    ];
    for (why, scene) in scenes {
        let mut device = Device::new(false);
        device.run(60.0, scene);
        assert_eq!(device.sequence(), [Mode::Indoor], "{why}");
    }
}

#[test]
fn between_indoor_and_night_the_centroid_says_outdoor() {
    let fade = |t: f64| [LIT * (-0.3 * t).exp() + DARK, DOTS, ROOM];
    let mut device = Device::new(false);
    device.run(30.0, &fade);
    assert_eq!(device.sequence(), [Mode::Indoor, Mode::Night]);
    let mut centroid = Device::new(false);
    centroid.switch.params.answer = Answer::PaperCentroid;
    centroid.run(30.0, &fade);
    assert_eq!(centroid.sequence(), [Mode::Indoor, Mode::Outdoor, Mode::Night]);
}

#[test]
fn a_chosen_mode_stays() {
    for (choice, mode) in [
        (ModeChoice::Indoor, Mode::Indoor),
        (ModeChoice::Night, Mode::Night),
        (ModeChoice::Outdoor, Mode::Outdoor),
        (ModeChoice::Wheels, Mode::Odometer),
    ] {
        let mut switch = ModeSwitch::new(choice, SwitchParams::default());
        let wanted = switch.wanted();
        for second in 0..20 {
            for stream in STREAMS {
                switch.see(stream, at(f64::from(second)), 0.0);
            }
            assert_eq!((switch.mode(), switch.wanted()), (mode, wanted));
        }
        assert_eq!(switch.report().answer, Mode::Odometer, "what the images say is reported all the same");
    }
}

#[test]
fn the_report_tells_how_the_mode_came_about() {
    let mut device = Device::new(true);
    device.run(20.0, &steady([LIT, DOTS, ROOM])).run(10.0, &steady([DARK, DOTS, ROOM]));
    let report = device.switch.report();
    assert_eq!((report.mode, report.answer), (Mode::Night, Mode::Night));
    assert_eq!(report.inference.degrees.night, 1.0);
    assert_eq!(report.energies, Energies { rgb: Some(DARK), infrared: Some(DOTS), depth: Some(ROOM) });
    let [colour, infrared, depth] = report.ages_s.map(Option::unwrap);
    assert!(colour > 5.0 && infrared < 0.1 && depth < 0.1, "{:?}", report.ages_s);
}

proptest! {
    /// Whatever the energies do within the margin about a breakpoint, in whatever order.
    #[test]
    fn noise_within_the_margin_changes_at_most_once(noise in prop::collection::vec(-1.0..1.0_f64, 600)) {
        let params = SwitchParams::default();
        let Breakpoints { low, high } = params.rgb;
        let noisy = |t: f64| {
            let share = 0.5 + 0.5 * params.margin * noise[(t * 15.0) as usize % noise.len()];
            [low + share * (high - low), DOTS, ROOM]
        };
        let mut device = Device::new(false);
        device.run(40.0, &noisy);
        prop_assert!(device.modes.len() <= 2, "{:?}", device.modes);
    }

    /// Noise within half the margin, independent from frame to frame, about any value of any input. An energy is a mean
    /// over 300,000 pixels: a sensor has less.
    #[test]
    fn noise_about_any_energy_changes_at_most_once(seed: u64, size in 0.0..0.5_f64, middle in 0.0..1.0_f64, input in 0..3_usize) {
        let params = SwitchParams::default();
        let Breakpoints { low, high } = [params.rgb, params.infrared, params.depth][input];
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let noise: Vec<f64> = (0..900).map(|_| random.random_range(-1.0..1.0)).collect();
        let noisy = |t: f64| {
            let share = middle + size * params.margin * noise[(t * 15.0) as usize % noise.len()];
            // Beside an infrared energy that wavers it is dark, or nothing would depend on it.
            let mut energies = if input == 1 { [DARK, DOTS, ROOM] } else { [LIT, DOTS, ROOM] };
            energies[input] = (low + share * (high - low)).max(0.0);
            energies
        };
        let mut device = Device::new(false);
        device.run(59.0, &noisy);
        // With the infrared input it is dark from the start: that is a change of its own.
        let most = if input == 1 { 3 } else { 2 };
        prop_assert!(device.modes.len() <= most, "{:?}", device.modes);
    }
}
