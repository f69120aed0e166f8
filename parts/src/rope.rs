//! Ropes.

multibody::multibody! {
    /// A rope from one point to another over a small pulley without friction: slack below its length, and a spring with a damper beyond.
    ///
    /// The tension `max(k d + c d', 0)` while `d = |from - over| + |over - to| - length` is positive pulls both ends to the pulley, and
    /// the pulley by both of its sides. A kink is left where the rope becomes taut.
    pub mod rope {
        port from: Frame;
        port over: Frame;
        port to: Frame;
        /// [m]
        param length = 1.0;
        /// [N/m]
        param stiffness = 1e4;
        /// [N s/m]
        param damping = 0.0;
        let first = over.position - from.position;
        let second = over.position - to.position;
        let ahead = first / norm(first);
        let behind = second / norm(second);
        /// [m]
        let stretch = norm(first) + norm(second) - length;
        /// [m/s]
        let speed = dot(ahead, over.velocity - from.velocity) + dot(behind, over.velocity - to.velocity);
        /// [N]
        let tension = select(stretch > 0.0, max(stiffness * stretch + damping * speed, 0.0), 0.0);
        force on_from: Force { at: from, value: tension * ahead, axes: ground }
        force on_to: Force { at: to, value: tension * behind, axes: ground }
        force on_pulley: Force { at: over, value: -tension * (ahead + behind), axes: ground }
    }
}
