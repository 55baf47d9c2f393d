//! Which of colour and infrared is asked for. A Kinect has one video stream for both; which images the answer to "what
//! now?" rests on must not depend on never having looked.

use crate::measurement::{Mode, Streams};
use crate::time::Timestamp;

use super::switch::{Stream, SwitchParams};

/// Colour and infrared no further apart than this were not taken in turns: half a period at 30 Hz, rounded up. Seconds.
const TOGETHER: f64 = 0.02;

/// What the video stream is asked to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shown {
    /// Both images; a device that must choose gives colour.
    Colour,
    /// Infrared alone.
    Infrared,
}

impl Shown {
    fn other(self) -> Self {
        match self {
            Self::Colour => Self::Infrared,
            Self::Infrared => Self::Colour,
        }
    }

    fn stream(self) -> Stream {
        match self {
            Self::Colour => Stream::Rgb,
            Self::Infrared => Stream::Infrared,
        }
    }
}

/// Asks for the stream that the mode rests on, and now and then has a look at the other.
#[derive(Clone, Debug)]
pub(super) struct Video {
    shown: Shown,
    /// Since when; `None` before the first reading of any kind.
    since: Option<Timestamp>,
    /// The stream that isn't shown was last, or never, seen then.
    left: Option<Timestamp>,
    rgb: Option<Timestamp>,
    infrared: Option<Timestamp>,
    /// When both came at once the last time.
    together: Option<Timestamp>,
}

impl Video {
    /// Asks for both, which tells whether both can be had.
    pub fn new() -> Self {
        Self { shown: Shown::Colour, since: None, left: None, rgb: None, infrared: None, together: None }
    }

    /// Takes note of an image.
    pub fn see(&mut self, stream: Stream, time: Timestamp) {
        let other = match stream {
            Stream::Rgb => {
                self.rgb = Some(time);
                self.infrared
            }
            Stream::Infrared => {
                self.infrared = Some(time);
                self.rgb
            }
            Stream::Depth => None,
        };
        if other.is_some_and(|other| time.since(other).abs() <= TOGETHER) {
            self.together = Some(time);
        }
    }

    /// Since when images of `stream` should be coming; `None` when none are due.
    pub fn due_since(&self, stream: Stream, now: Timestamp, params: &SwitchParams) -> Option<Timestamp> {
        (stream == self.shown.stream() || self.gives_both(now, params)).then_some(self.since?)
    }

    /// The stream that isn't asked for alone.
    pub fn hidden(&self) -> Stream {
        self.shown.other().stream()
    }

    /// Decides what to look at. `hidden_matters`: whether more or less in the other stream would change the mode.
    pub fn choose(&mut self, mode: Mode, hidden_matters: bool, now: Timestamp, params: &SwitchParams) {
        let since = *self.since.get_or_insert(now);
        let left = *self.left.get_or_insert(now);
        if self.gives_both(now, params) {
            self.show(Shown::Colour, now);
            return;
        }
        let needed = match mode {
            Mode::Indoor | Mode::Outdoor => Shown::Colour,
            Mode::Night => Shown::Infrared,
            // On wheels alone there is nothing to miss: whatever is shown is as good as the other.
            Mode::Odometer => self.shown,
        };
        let every = if mode == Mode::Odometer { params.look } else { params.look_every };
        if self.shown != needed {
            // Having a look, or the mode has just changed and the look with it.
            if now.since(since) >= params.look {
                self.show(needed, now);
            }
        } else if now.since(left) >= every && now.since(since) >= params.look && hidden_matters {
            self.show(self.shown.other(), now);
        }
    }

    /// What is wanted next.
    pub fn wanted(&self) -> Streams {
        Streams { rgb: self.shown == Shown::Colour, infrared: true, depth: true }
    }

    fn show(&mut self, shown: Shown, now: Timestamp) {
        if self.shown != shown {
            (self.shown, self.since, self.left) = (shown, Some(now), Some(now));
        }
    }

    /// Whether the device has lately given both at once.
    fn gives_both(&self, now: Timestamp, params: &SwitchParams) -> bool {
        self.together.is_some_and(|together| now.since(together) <= params.look)
    }
}
