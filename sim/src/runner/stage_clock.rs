//! Times the stages of the estimator's work on a frame. The estimator has no clock; this is the runner's: CPU time of the
//! thread that the estimator is on, so that what else the machine is busy with does not count.

use std::time::Duration;

use cpu_time::ThreadTime;
use sunblind_estimator::Stage;

/// Milliseconds by stage since the last [`take`](Self::take).
#[derive(Default)]
pub(super) struct StageClock {
    /// The thread's time when the stage began.
    running: Option<(Stage, Duration)>,
    spent_ms: [f64; 4],
}

impl StageClock {
    /// The estimator begins `stage`; what ran before ends.
    pub fn begin(&mut self, stage: Stage) {
        self.stop();
        self.running = Some((stage, ThreadTime::now().as_duration()));
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
        // One that was left running on another thread counts for nothing.
        self.spent_ms[slot] += ThreadTime::now().as_duration().saturating_sub(since).as_secs_f64() * 1e3;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two milliseconds of work.
    fn work() {
        let start = ThreadTime::now();
        while start.elapsed() < Duration::from_millis(2) {}
    }

    #[test]
    fn a_stage_lasts_until_the_next_and_counts_for_one_frame() {
        let mut clock = StageClock::default();
        clock.begin(Stage::Features);
        work();
        clock.begin(Stage::Done);
        work();
        let [registration, features, matching, motion] = clock.take();
        assert!(features >= 2.0, "{features} ms");
        assert_eq!([registration, matching, motion], [0.0; 3]);
        // A frame that fails within a stage never says that it is done.
        clock.begin(Stage::Motion);
        work();
        assert!(clock.take()[3] >= 2.0);
        assert_eq!(clock.take(), [0.0; 4]);
    }
}
