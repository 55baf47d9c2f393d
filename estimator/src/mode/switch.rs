//! The mode over time: an answer of the fuzzy rules counts once it has lasted.

use serde::{Deserialize, Serialize};

use super::energy::Energies;
use super::fuzzy::{Breakpoints, Degrees, Inference, Membership, Memberships};
use super::video::Video;
use crate::measurement::{Mode, Streams};
use crate::time::Timestamp;

/// A mode that less speaks for counts for no less, so that variances stay numbers: a hundredth of the weight is nothing.
const LEAST_DEGREE: f64 = 0.1;

/// Who decides on the mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ModeChoice {
    /// What the images hold.
    #[default]
    Auto,
    /// Always colour + depth.
    Indoor,
    /// Always infrared + depth.
    Night,
    /// Always colour alone, its length by the wheels.
    Outdoor,
    /// Never an image.
    Wheels,
}

/// How the degrees become one mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// The mode that most speaks for.
    #[default]
    Strongest,
    /// The mode whose number is nearest to the centroid. Between indoor and night that says "outdoor": for comparison.
    PaperCentroid,
}

/// Parameters of the mode switch.
///
/// The breakpoints were fitted to simulated drives, the laboratory, the doorway and the yard at night, where what the
/// images hold is known. Colour: in a lit room 0.16 to 0.34, under street lamps 0.02 to 0.03, nearly all of it noise, in
/// darkness 0.0002. Where a room's lamps are dimmed it holds enough down to 0.035, in the yard at dusk down to 0.095: the two
/// meet halfway, at 0.06. Infrared: 0.0002 in a yard at night whose dots still give depth; a chip's noise alone has 0.00001.
/// Depth: where 30 % of an image's pixels are right, 35 % have a value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SwitchParams {
    /// How the rules' degrees become one mode.
    pub answer: Answer,
    /// By how much more must speak for another mode than for the present one, 0–1. Fitted as the breakpoints; noise of
    /// half of it about a breakpoint changes nothing.
    pub margin: f64,
    /// How long it must go on doing so, seconds; but for the first mode. Fitted as the breakpoints: three frames at 15 Hz.
    /// A change should be followed within half a second, and some of that passes until the energies have changed.
    #[serde(rename = "dwell_s")]
    pub dwell: f64,
    /// An image that should have come and has not for this long is taken for black, seconds. A guess: fewer than one
    /// image a second is no use to odometry.
    #[serde(rename = "stale_s")]
    pub stale: f64,
    /// With a device that gives colour or infrared, never both: how long after the last look the other one is looked at
    /// again, where that could change the mode; seconds. A guess: each look costs [`look`](Self::look) of blindness.
    #[serde(rename = "look_every_s")]
    pub look_every: f64,
    /// How long such a look takes, with the switching of the device and the first exposures; seconds. A guess; longer
    /// than `stale_s`, or a stream that is missing is never found out.
    #[serde(rename = "look_s")]
    pub look: f64,
    /// Of colour's energy.
    pub rgb: Breakpoints,
    /// Of infrared's energy. Low is where not even dots are seen.
    pub infrared: Breakpoints,
    /// Of depth's energy.
    pub depth: Breakpoints,
}

impl Default for SwitchParams {
    fn default() -> Self {
        Self {
            answer: Answer::Strongest,
            margin: 0.3,
            dwell: 0.18,
            stale: 1.0,
            look_every: 15.0,
            look: 1.2,
            rgb: Breakpoints { low: 0.02, high: 0.1 },
            infrared: Breakpoints { low: 3e-5, high: 2e-4 },
            depth: Breakpoints { low: 0.32, high: 0.42 },
        }
    }
}

/// A kind of image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Colour.
    Rgb,
    /// Infrared.
    Infrared,
    /// Depth.
    Depth,
}

const STREAMS: [Stream; 3] = [Stream::Rgb, Stream::Infrared, Stream::Depth];

/// How the mode came about: for reports, and for whoever trusts a pose as far as its mode.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ModeReport {
    /// The mode.
    pub mode: Mode,
    /// The mode that the rules speak for just now; the mode follows once that has lasted.
    pub answer: Mode,
    /// Of the newest images; `None` where none has ever been seen, 0 where one should have come and has not.
    pub energies: Energies,
    /// How old they are, seconds, in the same order: colour, infrared, depth.
    pub ages_s: [Option<f64>; 3],
    /// How Low and High they are. What was never looked at counts as High.
    pub memberships: Memberships,
    /// How strongly the rules fire, and how much that speaks for each mode.
    pub inference: Inference,
}

/// What is known of one stream.
#[derive(Clone, Copy, Debug, Default)]
struct Sight {
    energy: Option<f64>,
    at: Option<Timestamp>,
}

/// Decides on the mode and on the images that are wanted for it.
#[derive(Clone, Debug)]
pub struct ModeSwitch {
    params: SwitchParams,
    choice: ModeChoice,
    sights: [Sight; 3],
    video: Video,
    started: Option<Timestamp>,
    now: Option<Timestamp>,
    mode: Mode,
    /// The mode is one that no image has spoken for.
    assumed: bool,
    inference: Inference,
    /// Another mode, and since when it has been the answer.
    pending: Option<(Mode, Timestamp)>,
}

impl ModeSwitch {
    /// Before the first image: where nothing has been looked at, colour and depth are assumed to be there.
    pub fn new(choice: ModeChoice, params: SwitchParams) -> Self {
        let sights = [Sight::default(); 3];
        let inference = Inference::of(&memberships(&sights, &params));
        let mode = match choice {
            ModeChoice::Auto | ModeChoice::Indoor => Mode::Indoor,
            ModeChoice::Night => Mode::Night,
            ModeChoice::Outdoor => Mode::Outdoor,
            ModeChoice::Wheels => Mode::Odometer,
        };
        let (started, now, pending) = (None, None, None);
        Self { params, choice, sights, video: Video::new(), started, now, mode, assumed: true, inference, pending }
    }

    /// The mode.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// By how much the variance of a motion that rests on the mode's images is too small, because little speaks for the
    /// mode any more; 1 for a mode that was chosen.
    pub fn doubt(&self) -> f64 {
        let degree = if self.choice == ModeChoice::Auto { self.inference.degrees.of(self.mode) } else { 1.0 };
        degree.max(LEAST_DEGREE).powi(-2)
    }

    /// The images that are wanted.
    pub fn wanted(&self) -> Streams {
        match self.choice {
            ModeChoice::Auto => self.video.wanted(),
            ModeChoice::Indoor => Streams { rgb: true, infrared: false, depth: true },
            ModeChoice::Night => Streams { rgb: false, infrared: true, depth: true },
            ModeChoice::Outdoor => Streams { rgb: true, infrared: false, depth: false },
            ModeChoice::Wheels => Streams { rgb: false, infrared: false, depth: false },
        }
    }

    /// How the mode came about.
    pub fn report(&self) -> ModeReport {
        let [rgb, infrared, depth] = self.sights.map(|sight| sight.energy);
        ModeReport {
            mode: self.mode,
            answer: self.answer(),
            energies: Energies { rgb, infrared, depth },
            ages_s: self.sights.map(|sight| Some(self.now?.since(sight.at?))),
            memberships: memberships(&self.sights, &self.params),
            inference: self.inference,
        }
    }

    /// Takes the energy of an image that was captured at `time`.
    pub fn see(&mut self, stream: Stream, time: Timestamp, energy: f64) {
        self.sights[stream as usize] = Sight { energy: Some(energy), at: Some(time) };
        self.video.see(stream, time);
        self.pass(time);
        self.decide(time);
    }

    /// Takes note that it is now at least `time`, whatever was measured then.
    pub fn pass(&mut self, time: Timestamp) {
        self.started.get_or_insert(time);
        let now = *self.now.insert(self.now.map_or(time, |now| now.max(time)));
        let mut missing = false;
        for stream in STREAMS {
            let due = match stream {
                Stream::Depth => self.started,
                other => self.video.due_since(other, now, &self.params),
            };
            let sight = &mut self.sights[stream as usize];
            // A stream that was just asked for is given the same time as one that has just stopped.
            let newest = due.max(sight.at.filter(|_| due.is_some()));
            if newest.is_some_and(|newest| now.since(newest) > self.params.stale) {
                sight.energy = Some(0.0);
                missing = true;
            }
        }
        // Time alone is no evidence, but that nothing comes is.
        if missing {
            self.decide(now);
        }
        let hidden_matters = self.matters(self.video.hidden());
        self.video.choose(self.mode, hidden_matters, now, &self.params);
    }

    fn answer(&self) -> Mode {
        let degrees = &self.inference.degrees;
        match self.params.answer {
            Answer::Strongest => {
                let strongest = degrees.strongest();
                let stays = degrees.of(self.mode) + self.params.margin >= degrees.of(strongest);
                if stays { self.mode } else { strongest }
            }
            Answer::PaperCentroid => degrees.centroid(),
        }
    }

    /// Asks the rules; `time` is when the newest evidence is of.
    fn decide(&mut self, time: Timestamp) {
        self.inference = Inference::of(&memberships(&self.sights, &self.params));
        if self.choice != ModeChoice::Auto {
            return;
        }
        let answer = self.answer();
        if self.assumed {
            self.mode = answer;
            let all_seen = self.sights.iter().all(|sight| sight.energy.is_some());
            self.assumed = !all_seen && self.started.is_none_or(|started| time.since(started) < self.params.dwell);
            return;
        }
        self.pending = match self.pending {
            _ if answer == self.mode => None,
            Some((pending, since)) if pending == answer => Some((pending, since)),
            _ => Some((answer, time)),
        };
        if let Some((pending, since)) = self.pending
            && time.since(since) >= self.params.dwell
        {
            self.mode = pending;
            self.pending = None;
        }
    }

    /// Whether the mode that the rules speak for depends on how much `stream` holds.
    fn matters(&self, stream: Stream) -> bool {
        let answer_at = |high: f64| {
            let mut supposed = memberships(&self.sights, &self.params);
            let membership = match stream {
                Stream::Rgb => &mut supposed.rgb,
                Stream::Infrared => &mut supposed.infrared,
                Stream::Depth => &mut supposed.depth,
            };
            *membership = Membership::of_high(high);
            let degrees: Degrees = Inference::of(&supposed).degrees;
            degrees.strongest()
        };
        answer_at(0.0) != answer_at(1.0)
    }
}

/// What was never looked at counts as High, so that it gets looked at before it is given up.
fn memberships(sights: &[Sight; 3], params: &SwitchParams) -> Memberships {
    let of = |stream: Stream, breakpoints: &Breakpoints| {
        let energy = sights[stream as usize].energy;
        energy.map_or(Membership::of_high(1.0), |energy| breakpoints.membership(energy))
    };
    Memberships {
        rgb: of(Stream::Rgb, &params.rgb),
        infrared: of(Stream::Infrared, &params.infrared),
        depth: of(Stream::Depth, &params.depth),
    }
}

#[cfg(test)]
mod tests;
