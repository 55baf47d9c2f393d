//! Which images a device's one video stream carries: colour or infrared, never both, and neither while it switches.
//! Depth has a stream of its own.

use sunblind_estimator::Timestamp;

/// The images of a frame, besides depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Carried {
    pub colour: bool,
    pub infrared: bool,
}

/// The video stream, as it was asked for last.
#[derive(Clone, Copy, Debug)]
pub(super) enum Video {
    /// A device that gives both at once, as the papers assume.
    Both,
    /// One that takes turns.
    OneOf {
        /// Infrared instead of colour.
        infrared: bool,
        /// How long a switch takes, nanoseconds.
        switch: i64,
        /// The last switch is over.
        ready_at: Timestamp,
    },
}

impl Video {
    /// Takes turns, and shows colour for now.
    pub fn exclusive(switch: f64) -> Self {
        Self::OneOf { infrared: false, switch: (switch * 1e9) as i64, ready_at: Timestamp::from_nanos(0) }
    }

    /// Begins to switch unless it shows what is wanted already, or is about to.
    pub fn want_infrared(&mut self, wanted: bool, now: Timestamp) {
        if let Self::OneOf { infrared, switch, ready_at } = self
            && *infrared != wanted
        {
            *infrared = wanted;
            *ready_at = Timestamp::from_nanos(now.as_nanos() + *switch);
        }
    }

    /// The images of a frame whose exposure began at `start` and has just ended: those that the stream has shown since.
    pub fn carries(&self, start: Timestamp) -> Carried {
        match *self {
            Self::Both => Carried { colour: true, infrared: true },
            Self::OneOf { infrared, ready_at, .. } => {
                let ready = start >= ready_at;
                Carried { colour: ready && !infrared, infrared: ready && infrared }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(millis: i64) -> Timestamp {
        Timestamp::from_nanos(millis * 1_000_000)
    }

    #[test]
    fn neither_comes_while_it_switches() {
        let mut video = Video::exclusive(0.2);
        let carried = |video: &Video, start| {
            let Carried { colour, infrared } = video.carries(at(start));
            (colour, infrared)
        };
        assert_eq!(carried(&video, 0), (true, false));
        video.want_infrared(true, at(100));
        // Being asked again is no second switch.
        video.want_infrared(true, at(150));
        assert_eq!(carried(&video, 90), (false, false), "what was being exposed is lost");
        assert_eq!(carried(&video, 299), (false, false));
        assert_eq!(carried(&video, 300), (false, true));
        // Whoever changes his mind waits once more.
        video.want_infrared(false, at(310));
        video.want_infrared(true, at(320));
        assert_eq!(carried(&video, 519), (false, false));
        assert_eq!(carried(&video, 520), (false, true));
    }

    #[test]
    fn both_come_from_a_device_of_the_papers() {
        let mut video = Video::Both;
        video.want_infrared(true, at(0));
        assert_eq!(video.carries(at(0)), Carried { colour: true, infrared: true });
    }
}
