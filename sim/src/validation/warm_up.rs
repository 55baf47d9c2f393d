//! Distances of a device that has just been switched on.

use super::bench::{Bench, Wall, gallery};
use super::statistics::mean;
use super::{Effort, Finding, Findings};
use crate::kinect::Imaging;
use crate::render::RenderError;

/// V15. Chow et al.: a target at 1.1 m moved by 1 cm in the first hour.
pub(super) fn drift(_: Effort) -> Findings {
    let z = 1.1;
    let world = gallery(&[Wall { angle: 5.0, ..Wall::at(z) }]);
    // Mean error of depth, millimetres, after so many seconds.
    let error_after = |warm_up: f64| -> Result<f64, RenderError> {
        let sample = Bench::with(&world, Imaging { warm_up, ..Imaging::default() })?.look()?.about(f64::from(z));
        Ok(mean(&sample.depths.iter().map(|[measured, truth]| 1000.0 * (measured - truth)).collect::<Vec<_>>()))
    };
    let (cold, half_an_hour, hour) = (error_after(0.0)?, error_after(1800.0)?, error_after(3600.0)?);
    Ok(vec![
        Finding::new("drift at 1.1 m in the first hour, mm", 10.0, 5.0..=15.0, (hour - cold).abs()),
        // Exponential: most of it comes first.
        Finding::new("share of that in the first half", 0.8, 0.6..=0.95, (half_an_hour - cold) / (hour - cold)),
    ])
}
