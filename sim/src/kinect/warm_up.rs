//! What a device does until it is warm: the projector turns a little against the camera as its housing expands, and
//! distances drift.
//!
//! Published is that a target at 1.1 m moved by 1 cm in the first hour, and that an hour of warming up should be allowed
//! for (Chow et al. 2012); that is 0.36 px of disparity. That it is a turn, which way, and how quickly, are guesses.

/// Tangent by which the projector points further towards the camera when cold: with a focal length of 580 px 0.38 px,
/// of which 0.36 px pass in an hour.
const COLD: f64 = 6.6e-4;
/// Seconds in which all but 1/e of it passes. A guess: after an hour 5 % is left.
const TIME_CONSTANT: f64 = 1200.0;

/// Tangent by which the projector points further towards the camera when the device has been on for so many seconds.
pub fn projector_turn(on_for: f64) -> f64 {
    COLD * (-on_for / TIME_CONSTANT).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_hour_passes_a_third_of_a_pixel_and_a_warm_device_does_not_drift() {
        let pixels = 580.0 * (projector_turn(0.0) - projector_turn(3600.0));
        assert!((pixels - 0.36).abs() < 0.01, "{pixels} px");
        assert_eq!(projector_turn(f64::INFINITY), 0.0);
    }
}
