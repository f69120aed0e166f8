//! The loops of the reference file with their digits.

// Reference digits stand as they were published.
#![allow(clippy::excessive_precision)]

use multibody_engine::symbolic::graph::Scalar;

use crate::cycle::Cycle;

const Z: usize = 2;

/// A loop, its moving knowns (symbol, rate, acceleration), and what the file says of each branch.
pub(crate) struct Reference {
    pub(crate) name: &'static str,
    pub(crate) cycle: Cycle,
    pub(crate) knowns: Vec<(Scalar, f64, f64)>,
    /// Each named quantity as (unknown, sign, known to add).
    pub(crate) quantities: Vec<(Scalar, f64, Option<Scalar>)>,
    /// By branch and quantity: value, rate, acceleration where given.
    pub(crate) branches: Vec<Vec<[Option<f64>; 3]>>,
}

fn crank(cycle: &mut Cycle, angle: f64, length: f64) -> Scalar {
    let q = cycle.known(angle);
    cycle.fixed(&[(Z, q)], [Scalar::ZERO; 3]);
    cycle.shift([length, 0.0, 0.0]);
    q
}

fn rrr() -> Reference {
    let mut c = Cycle::new();
    let q = crank(&mut c, 1.0, 1.0);
    let coupler = c.revolute(Z, true, 0.0);
    c.shift([3.5, 0.0, 0.0]);
    c.revolute(Z, false, 0.0);
    c.shift([-3.0, 0.0, 0.0]);
    let rocker = c.revolute(Z, true, 0.0);
    c.shift([-4.0, 0.0, 0.0]);
    let open = vec![
        [Some(0.638_947_907_787_067_466_64), Some(-0.444_320_678_020_159_69), None],
        [Some(1.789_251_403_387_524_766_1), Some(0.257_978_881_147_562_47), Some(1.588_940_210_204_704_7)],
    ];
    let crossed = vec![
        [Some(-1.116_124_470_400_680_299_7), Some(0.077_938_740_388_610_257), None],
        [Some(-2.266_427_966_001_137_599_2), Some(-0.624_360_818_779_111_9), Some(0.924_146_982_215_668_7)],
    ];
    Reference {
        name: "M1 RRR",
        cycle: c,
        knowns: vec![(q, 2.0, 0.0)],
        quantities: vec![(coupler, 1.0, Some(q)), (rocker, -1.0, None)],
        branches: vec![open, crossed],
    }
}

fn rrp() -> Reference {
    let mut c = Cycle::new();
    let q = crank(&mut c, 0.7, 1.0);
    let rod = c.revolute(Z, true, 0.0);
    c.shift([3.0, 0.0, 0.0]);
    c.revolute(Z, false, 0.0);
    let x = c.prismatic(0, true, 0.0);
    c.shift([0.0, -0.4, 0.0]);
    let first = vec![
        [Some(3.754_885_284_171_266_296_2), Some(-2.120_063_059_523_724_489_8), Some(-8.182_561_118_798_352_279_5)],
        [Some(-0.081_496_076_659_919_602_17), None, None],
    ];
    let second = vec![[Some(-2.225_200_909_602_289_443_7), None, None], [None; 3]];
    Reference {
        name: "M2 RRP",
        cycle: c,
        knowns: vec![(q, 3.0, 0.0)],
        quantities: vec![(x, -1.0, None), (rod, 1.0, Some(q))],
        branches: vec![first, second],
    }
}

fn rpr() -> Reference {
    let mut c = Cycle::new();
    let q = crank(&mut c, 0.7, 1.0);
    c.revolute(Z, false, 0.0);
    let travel = c.prismatic(0, true, 0.0);
    c.shift([0.0, -0.25, 0.0]);
    let arm = c.revolute(Z, true, 0.0);
    c.shift([0.0, 2.2, 0.0]);
    let first = vec![
        [Some(1.223_115_121_633_425_152_2), Some(0.885_563_323_592_489_589_67), Some(0.560_789_472_669_148_943_14)],
        [Some(2.934_630_781_520_196_730_5), Some(1.720_134_085_645_582_099_5), None],
    ];
    let second =
        vec![[Some(-1.748_508_724_178_817_895_8), None, None], [Some(-2.934_630_781_520_196_730_5), None, None]];
    Reference {
        name: "M3 RPR",
        cycle: c,
        knowns: vec![(q, 3.0, 0.0)],
        quantities: vec![(arm, -1.0, None), (travel, -1.0, None)],
        branches: vec![first, second],
    }
}

fn rssr() -> Reference {
    let mut c = Cycle::new();
    let q = crank(&mut c, 0.9, 0.5);
    c.ball([0.0; 3]);
    c.shift([1.0, 0.0, 0.0]);
    c.ball([0.0; 3]);
    c.shift([0.0, -0.7, 0.0]);
    let output = c.revolute(0, true, 0.0);
    c.shift([-1.0, -0.3, -0.2]);
    let first = [-2.668_350_532_275_787_254_6, 6.396_478_478_537_481_383, -9.918_535_139_410_727_698_6];
    let second = [0.386_255_894_002_212_993_21, -1.259_438_342_328_270_296_5, -15.123_049_209_938_624_18];
    Reference {
        name: "M4 RSSR",
        cycle: c,
        knowns: vec![(q, 2.0, 0.0)],
        quantities: vec![(output, -1.0, None)],
        branches: vec![vec![first.map(Some)], vec![second.map(Some)]],
    }
}

fn ups() -> Reference {
    let mut c = Cycle::new();
    let first = c.revolute(0, true, 0.0);
    let second = c.revolute(1, true, 0.0);
    let length = c.prismatic(Z, true, 0.0);
    c.ball([0.0; 3]);
    let d = [0.4, 0.5, 1.1].map(|x| c.known(-x));
    c.fixed(&[], d);
    let rates = [0.4, -0.3, 0.2];
    let accelerations = [1.0, -2.0, 0.5];
    let knowns = (0..3).map(|k| (d[k], -rates[k], -accelerations[k])).collect();
    let one = vec![
        [-0.426_627_493_126_876_089_22, 0.294_520_547_945_205_479_45, 1.649_840_495_402_514_543_1].map(Some),
        [0.319_687_259_130_279_910_52, 0.284_042_514_853_652_209_96, 0.731_289_893_105_346_635_13].map(Some),
        [1.272_792_206_135_785_543_9, 0.180_705_066_303_228_811_79, 0.162_906_150_754_843_150_51].map(Some),
    ];
    let two = vec![
        [Some(2.714_965_160_462_917_149_2), None, None],
        [Some(2.821_905_394_459_513_327_9), None, None],
        [Some(1.272_792_206_135_785_543_9), None, None],
    ];
    Reference {
        name: "M5 UPS",
        cycle: c,
        knowns,
        quantities: vec![(first, 1.0, None), (second, 1.0, None), (length, 1.0, None)],
        branches: vec![one, two],
    }
}

pub(crate) fn all() -> Vec<Reference> {
    vec![rrr(), rrp(), rpr(), rssr(), ups()]
}
