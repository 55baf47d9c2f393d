//! Times the stages of the estimator's work on a frame. The estimator has no clock; this is the runner's.

use std::time::Instant;

use sunblind_estimator::Stage;

/// Milliseconds by stage since the last [`take`](Self::take).
#[derive(Default)]
pub(super) struct StageClock {
    running: Option<(Stage, Instant)>,
    spent_ms: [f64; 4],
}

impl StageClock {
    /// The estimator begins `stage`; what ran before ends.
    pub fn begin(&mut self, stage: Stage) {
        self.stop();
        self.running = Some((stage, Instant::now()));
    }

    /// The times in the order of [`FrameLog::stage_ms`](super::log::FrameLog::stage_ms); the clock starts anew.
    pub fn take(&mut self) -> [f64; 4] {
        self.stop();
        std::mem::take(&mut self.spent_ms)
    }

    fn stop(&mut self) {
        let Some((stage, since)) = self.running.take() else { return };
        let slot = match stage {
            Stage::Registration => 0,
            Stage::Features => 1,
            Stage::Matching => 2,
            Stage::Motion => 3,
            Stage::Done => return,
        };
        self.spent_ms[slot] += since.elapsed().as_secs_f64() * 1e3;
    }
}

#[cfg(test)]
mod tests {
    use std::thread::sleep;
    use std::time::Duration;

    use super::*;

    #[test]
    fn a_stage_lasts_until_the_next_and_counts_for_one_frame() {
        let pause = || sleep(Duration::from_millis(2));
        let mut clock = StageClock::default();
        clock.begin(Stage::Features);
        pause();
        clock.begin(Stage::Done);
        pause();
        let [registration, features, matching, motion] = clock.take();
        assert!(features >= 2.0, "{features} ms");
        assert_eq!([registration, matching, motion], [0.0; 3]);
        // A frame that fails within a stage never says that it is done.
        clock.begin(Stage::Motion);
        pause();
        assert!(clock.take()[3] >= 2.0);
        assert_eq!(clock.take(), [0.0; 4]);
    }
}
