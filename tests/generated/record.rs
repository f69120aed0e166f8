//! What is recorded of a motion: names, units and values against the fields themselves, and text that is read back.

use multibody::nalgebra::{UnitQuaternion, Vector3};
use multibody::{Columns, Dop853, Integrator, Planar, Real, Recorder, multibody};
use std::io::{self, Write};

multibody! {
    mod arm {
        port root: Frame;
        /// [kg]
        param mass = 0.37;
        /// [N m]
        input drive;
        body link { mass: mass, com: [0.1, -0.3, 0.2], inertia: diag(0.11, 0.13, 0.07) }
        joint gimbal: Universal { parent: root, child: link, axes: [[1.0, 2.0, 2.0], [2.0, 1.0, -2.0]] }
        force motor: Effort { joint: gimbal.first, value: drive }
        /// [m]
        output tip = link.at([0.2, 0.5, -0.3]).position;
    }
    /// Joints of every type of field, on oblique axes, and arms in an array.
    pub mod crane {
        /// [m]
        param offset: Vec3 = [0.3, -0.7, 1.1];
        world { gravity: -9.81 * Y }
        body sled { mass: 2.0, com: 0.1 * offset, inertia: diag(0.3, 0.4, 0.5) }
        body bell { mass: 1.5, com: [0.2, 0.1, -0.4], inertia: diag(0.2, 0.3, 0.25) }
        joint slide: Planar { parent: ground.rotated([2.0, -1.0, 2.0], 1.1), child: sled, axis: Z }
        joint hang: Ball { parent: sled.at(offset), child: bell }
        part arms: [arm; 2] = |i| arm { root: bell.at([0.3, 0.2, -0.1]) };
        /// [m/s, or so]
        output speed = norm(bell.at(offset).velocity);
        output turned: Rotation = bell.rotation;
    }
}

/// Name, unit and value of every scalar.
fn columns<T: Real>(row: &impl Columns<T>) -> Vec<(String, &'static str, T)> {
    let mut list = Vec::new();
    row.each(&mut |column, value| list.push((column.to_string(), column.unit(), value)));
    list
}

fn moving() -> crane::State {
    let mut state = crane::State::default();
    state.q.slide = Planar { x: 0.1, y: -0.2, angle: 0.3 };
    state.q.hang = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -0.9, 0.2));
    state.q.arms[1].gimbal.second = -0.7;
    state.v.slide = Planar { x: 1.1, y: 1.2, angle: -1.3 };
    state.v.hang = Vector3::new(2.1, 2.2, 2.3);
    state.v.arms[0].gimbal.first = 3.1;
    state
}

#[test]
fn names_and_units_are_those_of_the_fields() {
    let state = moving();
    let (q, v) = (&state.q, &state.v);
    let expected = [
        ("q.slide.x", "m", q.slide.x),
        ("q.slide.y", "m", q.slide.y),
        ("q.slide.angle", "rad", q.slide.angle),
        ("q.hang.w", "", q.hang.w),
        ("q.hang.i", "", q.hang.i),
        ("q.hang.j", "", q.hang.j),
        ("q.hang.k", "", q.hang.k),
        ("q.arms[0].gimbal.first", "rad", q.arms[0].gimbal.first),
        ("q.arms[0].gimbal.second", "rad", q.arms[0].gimbal.second),
        ("q.arms[1].gimbal.first", "rad", q.arms[1].gimbal.first),
        ("q.arms[1].gimbal.second", "rad", q.arms[1].gimbal.second),
        ("v.slide.x", "m/s", v.slide.x),
        ("v.slide.y", "m/s", v.slide.y),
        ("v.slide.angle", "rad/s", v.slide.angle),
        ("v.hang.x", "rad/s", v.hang.x),
        ("v.hang.y", "rad/s", v.hang.y),
        ("v.hang.z", "rad/s", v.hang.z),
        ("v.arms[0].gimbal.first", "rad/s", v.arms[0].gimbal.first),
        ("v.arms[0].gimbal.second", "rad/s", v.arms[0].gimbal.second),
        ("v.arms[1].gimbal.first", "rad/s", v.arms[1].gimbal.first),
        ("v.arms[1].gimbal.second", "rad/s", v.arms[1].gimbal.second),
    ];
    assert_eq!(columns(&state), expected.map(|(name, unit, value)| (name.to_owned(), unit, value)));
    let input = columns(&crane::Input::<f64>::default());
    assert_eq!(input[1], ("arms[1].drive".to_owned(), "N m", 0.0));
}

#[test]
fn rotations_are_written_row_by_row() {
    let state = moving();
    let output = crane::Model::<f64>::default().outputs(0.0, &state, &crane::Input::default());
    let columns = columns(&(crane::Params::<f64>::default(), output));
    let value = |wanted: &str| columns.iter().find(|(name, ..)| name == wanted).map(|column| column.2).unwrap();
    for row in 0..3 {
        for column in 0..3 {
            assert_eq!(value(&format!("turned[{row}][{column}]")), output.turned[(row, column)]);
        }
    }
    assert_eq!(value("offset.z"), 1.1);
    assert_eq!(value("arms[1].mass"), 0.37);
}

#[test]
fn text_is_read_back_to_the_same_numbers() {
    let model = crane::Model::<f64>::default();
    let times = [0.0, 0.1, 1.0 / 3.0, 0.7];
    let (mut recorder, mut rows) = (Recorder::new(Vec::new()), Vec::new());
    let input = crane::Input::default();
    Integrator::adaptive(Dop853, 1e-8, 1e-8)
        .sampled(&model, 0.0, 0.7, &moving(), &input, times, |t, x| {
            let row = (*x, model.outputs(t, x, &input));
            recorder.observe(t, &row);
            rows.push((t, columns(&row)));
        })
        .unwrap();
    let text = String::from_utf8(recorder.finish().unwrap()).unwrap();
    let (header, lines) = text.split_once('\n').unwrap();
    assert!(header.starts_with("t [s],q.slide.x [m],"));
    assert!(header.contains(",q.hang.w,") && header.contains(",\"speed [m/s, or so]\","));
    assert_eq!((lines.lines().count(), rows.len()), (4, 4));
    for (line, (t, row)) in lines.lines().zip(&rows) {
        let read: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        assert_eq!(read[0], *t);
        assert_eq!(read[1..], row.iter().map(|column| column.2).collect::<Vec<_>>()[..]);
    }
}

#[test]
fn odd_numbers_survive_in_their_own_scalar() {
    let doubles = [0.1 + 0.2, -0.0, f64::MIN_POSITIVE / 3.0, 1.797e308, f64::INFINITY, 1e22];
    let mut recorder = Recorder::new(Vec::new());
    recorder.sample(-1e-9, &doubles).unwrap();
    let text = String::from_utf8(recorder.finish().unwrap()).unwrap();
    let read = text.lines().nth(1).unwrap().split(',').skip(1).map(|number| number.parse::<f64>().unwrap().to_bits());
    assert_eq!(read.collect::<Vec<_>>(), doubles.map(f64::to_bits));

    let mut recorder = Recorder::new(Vec::new());
    recorder.sample(0.0, &[0.1_f32, 1.0e-40]).unwrap();
    let text = String::from_utf8(recorder.finish().unwrap()).unwrap();
    assert_eq!(text, "t [s],[0],[1]\n0.0,0.1,1e-40\n");
}

/// Takes that many bytes and fails on the next.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn errors_of_the_writer_are_handed_on() {
    let mut recorder = Recorder::new(Full(30));
    assert!(recorder.sample(0.0, &[0.5, 0.25]).is_ok());
    assert_eq!(recorder.sample(0.1, &[0.5, 0.25]).unwrap_err().kind(), io::ErrorKind::StorageFull);

    let mut recorder = Recorder::new(Full(30));
    for k in 0..9 {
        recorder.observe(f64::from(k), &[0.5, 0.25]);
    }
    assert_eq!(recorder.finish().err().map(|error| error.kind()), Some(io::ErrorKind::StorageFull));
}
