//! From a velocity command to wheel speeds, as the robot's own controller does it.

/// What is asked of the robot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VelocityCommand {
    /// Forwards, m/s.
    pub speed: f64,
    /// To the left, rad/s.
    pub turn_rate: f64,
}

/// What the motors are told, rad/s; positive rolls forward.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WheelSpeeds {
    /// All wheels on the left: a belt couples them.
    pub left: f64,
    /// All wheels on the right.
    pub right: f64,
}

/// What the robot's controller allows and assumes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveParams {
    /// m/s, forwards and backwards.
    pub max_speed: f64,
    /// rad/s, either way.
    pub max_turn_rate: f64,
    /// m/s².
    pub acceleration: f64,
    /// rad/s².
    pub turn_acceleration: f64,
    /// The distance between two wheels that would turn the robot as all its wheels do; metres. A skid-steer robot
    /// turns less than its geometric track promises.
    pub effective_track: f64,
}

impl Default for DriveParams {
    /// A Pioneer P3-AT.
    fn default() -> Self {
        Self {
            // Webots' guide, after the data sheet: 0.7 m/s, 140°/s. (ARIA lets through 1.2 m/s and 300°/s.)
            max_speed: 0.7,
            max_turn_rate: 140_f64.to_radians(),
            // The controller's default, 300 mm/s²: from memory of the manual, low confidence.
            acceleration: 0.3,
            // The controller's default, 100°/s²: read from a robot by a p2os user.
            turn_acceleration: 100_f64.to_radians(),
            // ARIA's DiffConvFactor for the P3-AT, 0.0034 rad/mm: 2/0.0034 mm.
            effective_track: 0.588,
        }
    }
}

/// The controller at work: ramps speed and turn rate, each on its own, and shares them out to the sides.
#[derive(Clone, Debug)]
pub struct Drive {
    params: DriveParams,
    wheel_radius: f64,
    max_wheel_speed: f64,
    /// What it aims at in this moment.
    target: VelocityCommand,
}

impl Drive {
    /// At rest. `wheel_radius` in metres, `max_wheel_speed` in rad/s.
    pub fn new(params: DriveParams, wheel_radius: f64, max_wheel_speed: f64) -> Self {
        Self { params, wheel_radius, max_wheel_speed, target: VelocityCommand::default() }
    }

    /// The wheel speeds after following `command` for `duration` seconds. Too much is cut to the limits; a command
    /// that is no number stops the robot, for nobody meant it.
    pub fn follow(&mut self, command: VelocityCommand, duration: f64) -> WheelSpeeds {
        let DriveParams { max_speed, max_turn_rate, acceleration, turn_acceleration, .. } = self.params;
        self.target = VelocityCommand {
            speed: approach(self.target.speed, limited(command.speed, max_speed), acceleration * duration),
            turn_rate: approach(
                self.target.turn_rate,
                limited(command.turn_rate, max_turn_rate),
                turn_acceleration * duration,
            ),
        };
        self.wheel_speeds()
    }

    fn wheel_speeds(&self) -> WheelSpeeds {
        let turn = self.target.turn_rate * self.params.effective_track / 2.0;
        let left = (self.target.speed - turn) / self.wheel_radius;
        let right = (self.target.speed + turn) / self.wheel_radius;
        // Both shrink alike, so that the robot stays on its curve.
        let scale = (self.max_wheel_speed / left.abs().max(right.abs())).min(1.0);
        WheelSpeeds { left: left * scale, right: right * scale }
    }
}

fn limited(value: f64, limit: f64) -> f64 {
    if value.is_nan() { 0.0 } else { value.clamp(-limit, limit) }
}

fn approach(from: f64, to: f64, at_most: f64) -> f64 {
    from + (to - from).clamp(-at_most, at_most)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drive() -> Drive {
        Drive::new(DriveParams::default(), 0.111, 10.81)
    }

    #[test]
    fn speed_ramps_up_to_the_limit_and_no_further() {
        let mut drive = drive();
        let command = VelocityCommand { speed: 5.0, turn_rate: 0.0 };
        let first = drive.follow(command, 0.1);
        assert!((first.left * 0.111 - 0.03).abs() < 1e-12);
        let mut last = first;
        for _ in 0..100 {
            last = drive.follow(command, 0.1);
        }
        assert!((last.left * 0.111 - 0.7).abs() < 1e-12);
        assert_eq!(last.left, last.right);
    }

    #[test]
    fn a_left_turn_speeds_up_the_right_side() {
        let speeds = drive().follow(VelocityCommand { speed: 0.0, turn_rate: 0.5 }, 1.0);
        assert!((speeds.right - 0.5 * 0.294 / 0.111).abs() < 1e-12);
        assert_eq!(speeds.left, -speeds.right);
    }

    #[test]
    fn a_wheel_at_its_limit_does_not_bend_the_curve() {
        let mut drive = Drive::new(DriveParams::default(), 0.111, 5.0);
        let mut speeds = WheelSpeeds::default();
        for _ in 0..1000 {
            speeds = drive.follow(VelocityCommand { speed: 0.7, turn_rate: 1.0 }, 0.01);
        }
        assert!((speeds.right - 5.0).abs() < 1e-12);
        let curvature = (speeds.right - speeds.left) / (speeds.right + speeds.left) * 2.0 / 0.588;
        assert!((curvature - 1.0 / 0.7).abs() < 1e-9);
    }

    #[test]
    fn a_command_that_is_no_number_stops_the_robot() {
        let mut drive = drive();
        drive.follow(VelocityCommand { speed: 0.3, turn_rate: 0.0 }, 1.0);
        let speeds = drive.follow(VelocityCommand { speed: f64::NAN, turn_rate: f64::NAN }, 1.0);
        assert_eq!(speeds, WheelSpeeds::default());
    }
}
