//! A drawing of the mechanism where it stands by default: bodies, joints, frames, a scale.

use multibody_engine::mechanics::poses::Pose;

use super::document::{Figure, Table};
use super::html::escaped;
use super::labels::{Box2, Drawn, Wanted, place};
use super::scene::{Body, Mark, Scene};
use super::space::{AXES, Point, add, norm, scale};
use super::svg::{self, Picture, width};
use super::view::View;

/// Room for the mechanism, in pixels, and for names about it.
const ROOM: [f64; 2] = [620.0, 400.0];
const MARGIN: [f64; 2] = [110.0, 50.0];

/// Of the scale bar and its letters, below the mechanism.
const FOOT: f64 = 34.0;

const LABEL: f64 = 11.0;

/// Lengths of axes, of bodies and of the ground.
const TRIAD: f64 = 20.0;
const WORLD: f64 = 34.0;

/// A joint's axis on either side of it.
const AXIS: f64 = 22.0;

/// Beyond so many names those of an array's further elements are left out.
const MOST_NAMES: usize = 26;

/// Colours of bodies, as classes.
const COLOURS: usize = 8;

const LEGEND: [(&str, &str); 9] = [
    ("axis-x", "x axis of a frame"),
    ("axis-y", "y"),
    ("axis-z", "z"),
    ("mark-turns", "joint that turns"),
    ("mark-slides", "joint that slides"),
    ("mark-closes", "joint that closes a loop"),
    ("mark-centre", "centre of mass"),
    ("rods", "rod"),
    ("springs", "spring or damper"),
];

/// From metres to the sheet.
struct Sheet {
    view: View,
    scale: f64,
    /// Left and upper ends of the mechanism, in metres.
    corner: [f64; 2],
    size: [f64; 2],
}

impl Sheet {
    fn new(scene: &Scene, view: View) -> Sheet {
        let points: Vec<[f64; 2]> = scene.points().into_iter().map(|p| view.project(p)).collect();
        let bound = |k: usize, pick: fn(f64, f64) -> f64| points.iter().map(|p| p[k]).reduce(pick).unwrap_or(0.0);
        let least = [bound(0, f64::min), bound(1, f64::min)];
        let most = [bound(0, f64::max), bound(1, f64::max)];
        let extent = [most[0] - least[0], most[1] - least[1]];
        let fitting =
            (0..2).map(|k| ROOM[k] / extent[k]).filter(|scale| scale.is_finite()).fold(f64::INFINITY, f64::min);
        // What stands in one point has no scale: a metre fills a part of the sheet.
        let scale = if fitting.is_finite() { fitting } else { 120.0 };
        let [w, h] = [0, 1].map(|k| (extent[k] * scale).max(60.0));
        // What is narrower than the least stands in the middle of it.
        let corner = [least[0] - (w / scale - extent[0]) / 2.0, most[1] + (h / scale - extent[1]) / 2.0];
        Sheet { view, scale, corner, size: [w + 2.0 * MARGIN[0], h + 2.0 * MARGIN[1] + FOOT] }
    }

    fn at(&self, p: Point) -> [f64; 2] {
        let [x, y] = self.view.project(p);
        [MARGIN[0] + self.scale * (x - self.corner[0]), MARGIN[1] + self.scale * (self.corner[1] - y)]
    }

    /// So many pixels along a unit vector.
    fn along(&self, from: Point, way: Point, pixels: f64) -> [f64; 2] {
        self.at(add(from, scale(pixels / self.scale, way)))
    }
}

pub(super) fn figure(name: &str, scene: &Scene) -> Figure {
    let axes = |of: fn(&Mark) -> &Vec<Point>| -> Vec<Point> { scene.joints.iter().flat_map(of).copied().collect() };
    let (turns, slides) = (axes(|joint| &joint.turns), axes(|joint| &joint.slides));
    let axes = [&turns[..], &slides[..]];
    let view = View::of(&scene.frames(), scene.up).unwrap_or_else(|| View::new(&scene.points(), axes, scene.up));
    let sheet = Sheet::new(scene, view);
    let (svg, Names { of_elements, without_room }) = self::svg(name, scene, &sheet);
    let mut caption = format!("Orthographic, seen from {}, parameters at their defaults.", view.from());
    if !scene.is_closed {
        caption.push_str(" No configuration was found in which the loops are closed: coordinates stand at zero.");
    }
    if of_elements > 0 {
        caption.push_str(" Of arrays the first elements alone are named.");
    }
    if without_room > 0 {
        caption.push_str(&format!(" Names that find no room, {without_room} of them, are left out."));
    }
    let shown = |class: &str| match class {
        "mark-turns" => scene.joints.iter().any(|joint| shape(joint) == "turns" && !joint.closes),
        "mark-slides" => scene.joints.iter().any(|joint| shape(joint) == "slides" && !joint.closes),
        "mark-closes" => scene.joints.iter().any(|joint| joint.closes),
        "rods" => !scene.rods.is_empty(),
        "springs" => !scene.springs.is_empty(),
        _ => true,
    };
    Figure { svg, text: String::new(), caption, legend: LEGEND.into_iter().filter(|(class, _)| shown(class)).collect() }
}

/// Origins of bodies and places of joints, in metres.
pub(super) fn table(scene: &Scene) -> Table {
    let mut table = Table::new(["frame", "", "x [m]", "y [m]", "z [m]"], 2);
    let size = scene.points().into_iter().map(norm).fold(0.0, f64::max);
    let mut row = |name: &str, what: &str, p: Point| {
        let numbers = p.map(|x| metres(x, size));
        table.rows.push([format!("`{name}`"), what.to_owned()].into_iter().chain(numbers).collect());
    };
    scene.bodies.iter().for_each(|body| row(&body.name, "body", body.pose.origin));
    scene.joints.iter().for_each(|joint| row(&joint.name, "joint", joint.at));
    table
}

/// With as many digits as the mechanism's size gives a meaning to.
fn metres(x: f64, size: f64) -> String {
    let digits = (5.0 - size.max(1e-9).log10().ceil()).clamp(0.0, 12.0) as usize;
    let text = format!("{x:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// How many names are left out.
struct Names {
    of_elements: usize,
    without_room: usize,
}

/// The picture, and what is left out of it.
fn svg(name: &str, scene: &Scene, sheet: &Sheet) -> (String, Names) {
    let [w, h] = sheet.size;
    let picture = Picture::new("drawing", format!("The mechanism {name} in space"), w, h);
    let mut pen = Pen { picture, drawn: Drawn::default(), sheet };
    pen.ground(&scene.ground);
    scene.bodies.iter().enumerate().for_each(|(number, body)| pen.body(number, body));
    scene.guides.iter().for_each(|[a, b]| pen.line("guide", sheet.at(*a), sheet.at(*b)));
    scene.rods.iter().for_each(|[a, b]| pen.line("rod", sheet.at(*a), sheet.at(*b)));
    scene.springs.iter().for_each(|[a, b]| pen.spring(sheet.at(*a), sheet.at(*b)));
    scene.joints.iter().for_each(|joint| pen.axes(joint));
    scene.bodies.iter().for_each(|body| pen.triad(&body.pose, TRIAD));
    let world = Pose { origin: [0.0; 3], axes: AXES };
    pen.triad(&world, WORLD);
    for (axis, name) in world.axes.into_iter().zip(["x", "y", "z"]) {
        let ([u, v], [x, y]) = (sheet.at(world.origin), sheet.along(world.origin, axis, WORLD + 9.0));
        if (x - u).hypot(y - v) > 14.0 {
            pen.picture.text("world", "middle", [x, y + 4.0], name);
            pen.drawn.letters.push(about([x, y], 5.0));
        }
    }
    scene.joints.iter().for_each(|joint| pen.joint(joint));
    scene.bodies.iter().for_each(|body| pen.centre(body));
    let left_out = pen.names(scene);
    pen.bar();
    (pen.picture.finish(), left_out)
}

/// What draws, and what it has drawn.
struct Pen<'a> {
    picture: Picture,
    drawn: Drawn,
    sheet: &'a Sheet,
}

impl Pen<'_> {
    /// A line that names keep off.
    fn line(&mut self, class: &str, a: [f64; 2], b: [f64; 2]) {
        self.picture.line(class, a, b);
        self.drawn.lines.push([a, b]);
    }

    /// Hatched where something stands on it.
    fn ground(&mut self, points: &[Point]) {
        for [x, y] in distinct(points.iter().map(|&p| self.sheet.at(p))) {
            self.picture.line("ground", [x - 13.0, y + 9.0], [x + 13.0, y + 9.0]);
            for k in 0..5 {
                let x = x - 10.0 + 5.5 * f64::from(k);
                self.picture.line("ground", [x, y + 9.0], [x - 5.0, y + 14.0]);
            }
            self.drawn.marks.push(Box2 { at: [x - 15.0, y + 8.0], size: [30.0, 7.0] });
        }
    }

    /// Between the points that hold it: lines from the first, or their hull; to the centre of mass where there is one alone.
    fn body(&mut self, number: usize, body: &Body) {
        let class = format!("solid colour-{}", number % COLOURS);
        let anchors = distinct(body.anchors.iter().map(|&p| self.sheet.at(p)));
        let outline = hull(&anchors);
        if outline.len() > 2 {
            let points: Vec<String> = outline.iter().map(|p| p.map(svg::number).join(",")).collect();
            self.picture.add(&format!("<polygon class=\"{class}\" points=\"{}\"/>", points.join(" ")));
            let ends = outline.iter().zip(outline.iter().cycle().skip(1));
            self.drawn.lines.extend(ends.map(|(&a, &b)| [a, b]));
            return;
        }
        let first = anchors.first().copied().unwrap_or_else(|| self.sheet.at(body.pose.origin));
        for &to in anchors.iter().skip(1) {
            self.line(&class, first, to);
        }
        let centre = self.sheet.at(body.centre);
        if anchors.len() < 2 && distance(first, centre) > 1.0 {
            self.line(&class, first, centre);
        }
    }

    fn spring(&mut self, a: [f64; 2], b: [f64; 2]) {
        self.picture.add(&format!("<path class=\"spring\" d=\"{}\"/>", zigzag(a, b)));
        self.drawn.lines.push([a, b]);
    }

    /// Directions of turns and slides that are not seen end on.
    fn axes(&mut self, joint: &Mark) {
        for &axis in joint.turns.iter().chain(&joint.slides) {
            let [a, b] = [AXIS, -AXIS].map(|length| self.sheet.along(joint.at, axis, length));
            if distance(a, b) > 8.0 {
                self.picture.line("axis", a, b);
            }
        }
    }

    fn triad(&mut self, pose: &Pose, length: f64) {
        let from = self.sheet.at(pose.origin);
        for (axis, class) in pose.axes.into_iter().zip(["axis-x", "axis-y", "axis-z"]) {
            let to = self.sheet.along(pose.origin, axis, length);
            if distance(from, to) > 1.5 {
                self.line(class, from, to);
            }
        }
    }

    /// A circle for what turns, a bar along what slides, a square for what does neither.
    fn joint(&mut self, joint: &Mark) {
        let [x, y] = self.sheet.at(joint.at);
        self.drawn.marks.push(about([x, y], 6.0));
        let closes = if joint.closes { " closes" } else { "" };
        let title = format!("<title>{}</title>", escaped(&joint.name));
        let [u, v] = [x, y].map(svg::number);
        self.picture.add(&match shape(joint) {
            "slides" => {
                let way = joint.slides.first().map_or([x + 1.0, y], |&way| self.sheet.along(joint.at, way, 10.0));
                // Seen end on it is a square.
                let long = (distance([x, y], way) * 0.9).max(4.5);
                let turn = svg::number((way[1] - y).atan2(way[0] - x).to_degrees());
                let [left, width] = [-long, 2.0 * long].map(svg::number);
                format!(
                    "<rect class=\"mark slides{closes}\" x=\"{left}\" y=\"-4.5\" width=\"{width}\" height=\"9\" \
                     transform=\"translate({u} {v}) rotate({turn})\">{title}</rect>"
                )
            }
            "turns" => format!("<circle class=\"mark turns{closes}\" cx=\"{u}\" cy=\"{v}\" r=\"4.5\">{title}</circle>"),
            _ => {
                let [left, top] = [x - 3.5, y - 3.5].map(svg::number);
                format!(
                    "<rect class=\"mark holds{closes}\" x=\"{left}\" y=\"{top}\" width=\"7\" height=\"7\">{title}</rect>"
                )
            }
        });
    }

    /// A centre of mass: a circle with two quarters filled.
    fn centre(&mut self, body: &Body) {
        let [x, y] = self.sheet.at(body.centre);
        let [u, v] = [x, y].map(svg::number);
        let [left, right, top, bottom] = [x - 4.0, x + 4.0, y - 4.0, y + 4.0].map(svg::number);
        let title = escaped(&body.name);
        self.picture.add(&format!(
            "<g class=\"centre\"><title>centre of mass of {title}</title><circle cx=\"{u}\" cy=\"{v}\" r=\"4\"/>\
             <path d=\"M{u} {v} L{right} {v} A4 4 0 0 0 {u} {top} Z M{u} {v} L{left} {v} A4 4 0 0 0 {u} {bottom} Z\"/></g>"
        ));
        self.drawn.marks.push(about([x, y], 4.0));
    }

    /// Names of joints, then of bodies.
    fn names(&mut self, scene: &Scene) -> Names {
        let joints =
            scene.joints.iter().map(|joint| (joint.name.as_str(), "joint-name".to_owned(), self.sheet.at(joint.at)));
        let bodies = scene.bodies.iter().enumerate().map(|(number, body)| {
            let anchors = distinct(body.anchors.iter().map(|&p| self.sheet.at(p)));
            let at = match &anchors[..] {
                [a, b] => [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0],
                _ => self.sheet.at(body.centre),
            };
            (body.name.as_str(), format!("body-name colour-{}", number % COLOURS), at)
        });
        let mut all: Vec<(&str, String, [f64; 2])> = joints.chain(bodies).collect();
        let count = all.len();
        if count > MOST_NAMES {
            all.retain(|(name, ..)| is_first(name));
        }
        let wanted: Vec<Wanted> =
            all.iter().map(|(name, _, at)| Wanted { at: *at, size: [width(name, LABEL) + 2.0, LABEL + 3.0] }).collect();
        let [w, h] = self.sheet.size;
        let places = place(&wanted, &self.drawn, Box2 { at: [2.0, 2.0], size: [w - 4.0, h - FOOT] });
        let mut found = 0;
        for ((name, class, at), place) in all.iter().zip(places) {
            let Some(Box2 { at: [x, y], size: [w, h] }) = place else { continue };
            found += 1;
            // What stands away from its point is led to it.
            let near = [at[0].clamp(x, x + w), at[1].clamp(y, y + h)];
            if distance(near, *at) > 20.0 {
                self.picture.line("leader", near, *at);
            }
            self.picture.text(class, "start", [x + 1.0, y + LABEL], name);
        }
        Names { of_elements: count - all.len(), without_room: all.len() - found }
    }

    /// A round length in metres, about a sixth of the sheet.
    fn bar(&mut self) {
        let [_, h] = self.sheet.size;
        let most = 150.0 / self.sheet.scale;
        let ten = 10_f64.powf(most.log10().floor());
        let length = [5.0, 2.0, 1.0].map(|k| k * ten).into_iter().find(|length| *length <= most).unwrap_or(ten);
        let (x, y) = (12.0, h - 14.0);
        let end = x + length * self.sheet.scale;
        self.picture.line("bar", [x, y], [end, y]);
        [x, end].into_iter().for_each(|x| self.picture.line("bar", [x, y - 4.0], [x, y + 4.0]));
        let digits = (-length.log10().floor()).max(0.0) as usize;
        self.picture.text("world", "start", [end + 8.0, y + 4.0], &format!("{length:.digits$} m"));
    }
}

/// The first element of each array that a name passes.
fn is_first(name: &str) -> bool {
    name.split('[').skip(1).all(|rest| rest.starts_with("0]"))
}

fn shape(joint: &Mark) -> &'static str {
    match (joint.turns.is_empty(), joint.slides.is_empty()) {
        (true, false) => "slides",
        // A ball has no written directions, and turns.
        _ if joint.moves => "turns",
        _ => "holds",
    }
}

fn about([x, y]: [f64; 2], half: f64) -> Box2 {
    Box2 { at: [x - half, y - half], size: [2.0 * half; 2] }
}

fn distance([x, y]: [f64; 2], [u, v]: [f64; 2]) -> f64 {
    (x - u).hypot(y - v)
}

/// Points that are not one on paper.
fn distinct(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut found: Vec<[f64; 2]> = Vec::new();
    for p in points {
        if found.iter().all(|other| distance(*other, p) > 1.0) {
            found.push(p);
        }
    }
    found
}

/// The corners of the convex hull (Andrew's monotone chain); fewer than three where points stand on a line.
fn hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) <= distance(a, p)
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut corners = half(&mut sorted.iter().copied());
    corners.extend(half(&mut sorted.iter().rev().copied()));
    corners
}

/// A spring between two points.
fn zigzag(a: [f64; 2], b: [f64; 2]) -> String {
    let length = distance(a, b);
    let [x, y] = [(b[0] - a[0]) / length.max(1e-9), (b[1] - a[1]) / length.max(1e-9)];
    let turns = (length / 8.0).clamp(4.0, 40.0).floor();
    let mut path = format!("M{} {}", svg::number(a[0]), svg::number(a[1]));
    for k in 0..turns as usize {
        let along = length * (0.15 + 0.7 * (k as f64 + 0.5) / turns);
        let side = if k % 2 == 0 { 5.0 } else { -5.0 };
        let p = [a[0] + along * x - side * y, a[1] + along * y + side * x].map(svg::number);
        path.push_str(&format!(" L{} {}", p[0], p[1]));
    }
    path.push_str(&format!(" L{} {}", svg::number(b[0]), svg::number(b[1])));
    path
}
