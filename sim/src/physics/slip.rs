//! How tyres slip: the contact hook.

use rapier3d::prelude::*;

use super::floor::Grip;

/// What touches the ground, and how the ground holds it in this step.
#[derive(Clone, Copy, Debug)]
pub(super) struct GroundContact {
    pub(super) tyre: ColliderHandle,
    pub(super) wheel: RigidBodyHandle,
    pub(super) radius: f64,
    pub(super) grip: Grip,
}

/// Tells the solver what slip each tyre's contact is at rest with.
pub(super) struct Slip {
    pub(super) contacts: Vec<GroundContact>,
}

impl PhysicsHooks for Slip {
    /// The solver brings the contact's velocity *plus* what is set here to zero. With α·v_x + s·ωR along the wheel
    /// (v_x: the tyre's slip, ω: the wheel's turning) it sees (1+α)·v_x + s·ωR: slip along the wheel weighs 1+α
    /// against slip across it, and a wheel rolls in equilibrium at v_x = −s·ωR/(1+α).
    fn modify_solver_contacts(&self, context: &mut ContactModificationContext) {
        let of = |collider| self.contacts.iter().find(|contact| contact.tyre == collider);
        // What is set counts for the first collider relative to the second.
        let (contact, sign) = match (of(context.collider1), of(context.collider2)) {
            (Some(contact), _) => (contact, 1.0),
            (None, Some(contact)) => (contact, -1.0),
            (None, None) => return,
        };
        let wheel = &context.bodies[contact.wheel];
        let Grip { anisotropy, slip, friction } = contact.grip;
        let axle = wheel.rotation() * Vector::Y;
        let rolling_speed = wheel.angvel().dot(axle) * contact.radius;
        let Some(manifold) = context.rigid_mut() else { return };
        // The normal points away from the first collider.
        let up = *manifold.normal * -sign;
        let forward = axle.cross(up).normalize_or_zero();
        *manifold.friction = friction;
        for solver_contact in manifold.solver_contacts.iter_mut() {
            let slip_along = wheel.velocity_at_point(solver_contact.anchor1).dot(forward);
            solver_contact.tangent_velocity = forward * (sign * (anisotropy * slip_along + slip * rolling_speed));
        }
    }
}
