//! Numbers that sine and cosine are computed with, the same in `software` and in `lanes`: parts of pi/2, and minimax
//! polynomials in the relative error (Remez). `runtime/tools/trigonometry.py` makes them; why pi/2 has four parts stands in
//! `software/sine.rs`.

pub(super) mod f32 {
    /// [rad] largest angle that is reduced by subtraction.
    pub(in super::super) const LIMIT: f32 = 12_800.0;
    /// Added and subtracted, it rounds to the nearest whole number; the lowest bits of the sum are that number's.
    pub(in super::super) const SHIFTER: f32 = 12_582_912.0;
    /// pi/2 in parts.
    pub(in super::super) const HALF_PI: [f32; 4] = [1.570_312_5, 4.837_513e-4, 7.549_533_6e-8, 2.563_344_2e-12];
    /// (sin(r) / r - 1) / r^2 by powers of r^2.
    pub(in super::super) const SINE: [f32; 3] = [-0.166_666_55, 0.008_332_189, -0.000_195_182_85];
    /// (cos(r) - 1 + r^2 / 2) / r^4 by powers of r^2.
    pub(in super::super) const COSINE: [f32; 3] = [0.041_666_646, -0.001_388_731, 2.443_232_7e-5];
}

pub(super) mod f64 {
    /// [rad] largest angle that is reduced by subtraction.
    pub(in super::super) const LIMIT: f64 = 1.0e6;
    /// Added and subtracted, it rounds to the nearest whole number; the lowest bits of the sum are that number's.
    pub(in super::super) const SHIFTER: f64 = 6_755_399_441_055_744.0;
    /// pi/2 in parts.
    pub(in super::super) const HALF_PI: [f64; 4] =
        [1.570_796_326_734_125_6, 6.077_094_383_272_197e-11, 6.123_233_994_092_14e-17, 1.644_625_693_632_425_8e-26];
    /// (sin(r) / r - 1) / r^2 by powers of r^2.
    pub(in super::super) const SINE: [f64; 6] = [
        -0.166_666_666_666_666_3,
        0.008_333_333_333_321_84,
        -0.000_198_412_698_293_585_28,
        2.755_731_353_851_453e-6,
        -2.505_073_438_940_085_4e-8,
        1.589_543_330_610_078e-10,
    ];
    /// (cos(r) - 1 + r^2 / 2) / r^4 by powers of r^2.
    pub(in super::super) const COSINE: [f64; 6] = [
        0.041_666_666_666_666_595,
        -0.001_388_888_888_887_333_8,
        2.480_158_728_899_748e-5,
        -2.755_731_421_529_909e-7,
        2.087_570_511_498_386e-9,
        -1.135_873_277_503_408_8e-11,
    ];
}
