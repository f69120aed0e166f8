//! Counts of `models/required.rs`, as a person reduces them by hand.

/// A function of a model, by hand and as it is emitted today.
pub struct Case {
    /// Of the generated module.
    pub model: &'static str,
    /// Of the generated method.
    pub function: &'static str,
    /// Additions, products, quotients, roots, sines with their cosines, with every number a literal.
    pub hand: [u32; 5],
    /// Additions, products, quotients and roots that are emitted; more are an error.
    pub emitted: u32,
    /// What is computed by hand.
    pub form: &'static str,
}

impl Case {
    /// Additions, products, quotients and roots by hand.
    pub fn flops(&self) -> u32 {
        self.hand[..4].iter().sum()
    }

    /// Sines with their cosines by hand.
    pub fn sincos(&self) -> u32 {
        self.hand[4]
    }
}

const fn case(model: &'static str, function: &'static str, hand: [u32; 5], emitted: u32, form: &'static str) -> Case {
    Case { model, function, hand, emitted, form }
}

/// All of them. Platform: hand counts with the rows of the level one reduced by hand, of any orientation assuming pins above
/// the base.
#[rustfmt::skip]
pub const CASES: &[Case] = &[
    case("pendulum", "forward_dynamics", [0, 1, 0, 0, 1], 1, "-(g / l) sin q"),
    case("pendulum", "inverse_dynamics", [1, 2, 0, 0, 1], 3, "J a + m g l sin q"),
    case("pendulum", "mass_matrix", [0, 0, 0, 0, 0], 0, "a literal"),
    case("pendulum_of_any_shape", "forward_dynamics", [0, 1, 0, 0, 1], 1, "-(m g l / J) sin q: one moment and one arm are left of ten numbers"),
    case("pendulum_with_friction", "forward_dynamics", [1, 2, 0, 0, 1], 3, "a product and a sum for the friction"),
    case("pendulum_without_gravity", "forward_dynamics", [0, 0, 0, 0, 0], 0, "nothing"),
    case("turntable", "forward_dynamics", [0, 0, 0, 0, 0], 0, "nothing"),
    case("turntable", "inverse_dynamics", [0, 1, 0, 0, 0], 1, "J a"),
    case("free", "forward_dynamics", [0, 6, 0, 0, 0], 6, "Euler's equations: c w w, three times; nothing for the linear ones"),
    case("free_in_gravity", "forward_dynamics", [0, 6, 0, 0, 0], 6, "the same: it falls as all do"),
    case("free_symmetric", "forward_dynamics", [0, 3, 0, 0, 0], 3, "s = c wz; s wy, -s wx, 0"),
    case("free_sphere", "forward_dynamics", [0, 0, 0, 0, 0], 0, "nothing"),
    case("free_in_any_axes", "forward_dynamics", [15, 24, 0, 0, 0], 40, "I w, w x I w, and the inverse of I"),
    case("free_beside_its_centre", "forward_dynamics", [18, 26, 0, 0, 0], 51, "Euler's equations, U c, and R times that by the two products with the quaternion's vector"),
    case("free_off_its_centre", "forward_dynamics", [30, 33, 0, 0, 0], 77, "the same, with all nine entries of U"),
    case("free_seen", "outputs", [0, 0, 0, 0, 0], 0, "they are coordinates, or zero"),
    case("plate_in_a_plane", "forward_dynamics", [0, 0, 0, 0, 0], 0, "nothing"),
    case("plate_in_a_plane", "inverse_dynamics", [1, 3, 0, 0, 0], 4, "m ax, m (ay + g), J a"),
    case("point_in_a_plane", "forward_dynamics", [0, 0, 0, 0, 0], 0, "nothing"),
    case("ball", "forward_dynamics", [0, 6, 0, 0, 0], 6, "Euler's equations about the point"),
    case("ball_symmetric", "forward_dynamics", [4, 9, 0, 0, 0], 13, "3 for the gyroscopic terms, 6 and 2 sums for gravity, 2 sums"),
    case("ball_round", "forward_dynamics", [2, 6, 0, 0, 0], 8, "k (qj qk + qw qi), -k (qi qk - qw qj), 0"),
    case("ball_balanced", "forward_dynamics", [0, 0, 0, 0, 0], 0, "nothing"),
    case("double_points", "forward_dynamics", [8, 13, 1, 0, 2], 26, "Lagrange's equations in absolute angles, sin(q1 + q2) from the sines of both"),
    case("double_points", "inverse_dynamics", [10, 14, 0, 0, 2], 23, "the same, without the solution"),
    case("double_points", "mass_matrix", [2, 2, 0, 0, 1], 4, "K + 2 B cos q2, C + B cos q2, C"),
    case("double_points", "bias", [5, 9, 0, 0, 2], 16, "B s w1^2 + G2 s12, the same - B s w12^2 + G1 s1"),
    case("double_rods", "forward_dynamics", [8, 13, 1, 0, 2], 26, "as of points, with other literals"),
    case("double_rods", "inverse_dynamics", [10, 14, 0, 0, 2], 25, "as of points, with other literals"),
    case("double_rods", "mass_matrix", [2, 2, 0, 0, 1], 4, "as of points, with other literals"),
    case("double_bodies", "forward_dynamics", [14, 20, 1, 0, 2], 41, "each centre of mass off the line: B cos q2 + A sin q2 and its derivative"),
    case("double_bodies", "inverse_dynamics", [15, 20, 0, 0, 2], 38, "the same, without the solution"),
    case("double_bodies", "mass_matrix", [3, 3, 0, 0, 1], 6, "K + 2 P, C + P, C with P = B cos q2 + A sin q2"),
    case("double_without_gravity", "forward_dynamics", [5, 10, 1, 0, 1], 15, "less two sines, their products and sums"),
    case("double_without_gravity", "inverse_dynamics", [7, 10, 0, 0, 1], 17, "less two sines, their products and sums"),
    case("double_with_friction", "forward_dynamics", [11, 16, 1, 0, 2], 31, "d1 w1, and d2 w2 in two scales"),
    case("double_welded", "forward_dynamics", [0, 1, 0, 0, 1], 1, "a pendulum"),
    case("double_welded", "inverse_dynamics", [1, 2, 0, 0, 1], 3, "a pendulum"),
    case("double_welded", "mass_matrix", [0, 0, 0, 0, 0], 0, "a pendulum"),
    case("double_held", "forward_dynamics", [0, 1, 0, 0, 1], 1, "a pendulum"),
    case("double_held", "inverse_dynamics", [1, 2, 0, 0, 1], 3, "a pendulum"),
    case("double_held", "mass_matrix", [0, 0, 0, 0, 0], 0, "a pendulum"),
    case("double_hung", "forward_dynamics", [0, 1, 0, 0, 1], 1, "two pendulums in one, the lower body never turns"),
    case("double_seen", "outputs", [0, 2, 0, 0, 1], 2, "l sin q, -l cos q of the first hinge alone"),
    case("double_tip_seen", "outputs", [3, 4, 0, 0, 2], 7, "l1 sin q1 + l2 sin(q1 + q2), cosines"),
    case("double_spin_seen", "outputs", [1, 0, 0, 0, 0], 1, "w1 + w2"),
    case("spherical", "forward_dynamics", [2, 8, 1, 0, 2], 13, "(2 s w1 w2 - g sin a) / c, -s (c w1^2 + g cos a)"),
    case("spherical", "inverse_dynamics", [4, 12, 0, 0, 2], 16, "the same, without the solution"),
    case("spherical", "mass_matrix", [0, 2, 0, 0, 1], 2, "m l^2 c^2, m l^2"),
    case("spherical_by_carrier", "forward_dynamics", [2, 8, 1, 0, 2], 13, "as by a universal joint"),
    case("spherical_by_carrier", "inverse_dynamics", [4, 12, 0, 0, 2], 16, "as by a universal joint"),
    case("spherical_by_carrier", "mass_matrix", [0, 2, 0, 0, 1], 2, "as by a universal joint"),
    case("spherical_without_gravity", "forward_dynamics", [0, 5, 1, 0, 1], 7, "2 s w1 w2 / c, -s c w1^2"),
    case("spherical_held", "forward_dynamics", [0, 1, 0, 0, 1], 1, "a pendulum"),
    case("arm_mass_matrix", "mass_matrix", [6, 9, 0, 0, 2], 19, "J + m1 r1^2 + m2 r2^2, and the double pendulum's"),
    case("arm_in_its_plane", "forward_dynamics", [8, 13, 1, 0, 2], 26, "a double pendulum"),
    case("arm_in_its_plane", "inverse_dynamics", [10, 14, 0, 0, 2], 23, "a double pendulum"),
    case("arm_in_its_plane", "mass_matrix", [2, 2, 0, 0, 1], 4, "a double pendulum"),
    case("arm_held_in_its_plane", "inverse_dynamics", [10, 14, 0, 0, 2], 23, "a double pendulum"),
    case("arm_held_in_its_plane", "mass_matrix", [2, 2, 0, 0, 1], 4, "a double pendulum"),
    case("cart_pole", "forward_dynamics", [4, 9, 1, 0, 1], 15, "two equations, by Cramer's rule"),
    case("cart_pole", "inverse_dynamics", [5, 9, 0, 0, 1], 14, "the same, without the solution"),
    case("cart_pole_without_gravity", "forward_dynamics", [1, 5, 1, 0, 1], 7, "x = k s w^2 / (c^2 - d), h c x"),
    case("cart_driven", "forward_dynamics", [0, 1, 0, 0, 1], 1, "a pendulum"),
    case("parallelograms_1", "forward_dynamics", [0, 1, 0, 0, 1], 1, "-(k) cos q"),
    case("parallelograms_2", "forward_dynamics", [0, 1, 0, 0, 1], 1, "the same"),
    case("parallelograms_10", "forward_dynamics", [0, 1, 0, 0, 1], 1, "the same"),
    case("parallelograms_40", "forward_dynamics", [0, 1, 0, 0, 1], 1, "the same"),
    case("slider_crank", "forward_dynamics", [5, 14, 2, 1, 1], 24, "x' = -y (1 + p), p = r c / u, u = sqrt(1 - y^2); -m x' x'' w^2 / (J + m x'^2)"),
    case("slider_crank_in_gravity", "forward_dynamics", [6, 15, 2, 1, 1], 28, "k r c more"),
    case("slider_crank_seen", "outputs", [2, 3, 0, 1, 1], 6, "r c + sqrt(1 - y^2)"),
    case("stewart, level", "inverse_dynamics", [0, 316, 0, 0, 0], 301, "published by count alone: additions and all else in one number"),
    case("stewart, reduced", "inverse_dynamics", [0, 929, 0, 0, 3], 924, "any orientation; in one number"),
    case("stewart, reduced", "forward_dynamics", [0, 1060, 0, 0, 3], 1020, "any orientation; in one number"),
];
