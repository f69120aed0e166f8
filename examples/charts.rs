//! Curves of examples, drawn side by side into a file of SVG.

use std::error::Error;
use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;

pub(crate) const BLUE: RGBColor = RGBColor(30, 80, 200);
pub(crate) const RED: RGBColor = RGBColor(210, 40, 40);
pub(crate) const GREY: RGBColor = RGBColor(150, 150, 150);

/// Points with a name.
pub(crate) struct Curve {
    pub(crate) name: &'static str,
    pub(crate) colour: RGBColor,
    pub(crate) points: Vec<(f64, f64)>,
    /// Points are not joined by a line.
    pub(crate) is_dotted: bool,
}

/// Curves over one pair of axes.
pub(crate) struct Chart {
    pub(crate) title: &'static str,
    /// What is along both axes, with units.
    pub(crate) axes: [&'static str; 2],
    pub(crate) curves: Vec<Curve>,
    /// A part of the first axis that stands out, with what it is.
    pub(crate) band: Option<(f64, f64, &'static str)>,
    /// What is beyond on the second axis is left out; without it all is shown.
    pub(crate) limits: Option<Range<f64>>,
    /// Both axes have one scale.
    pub(crate) is_map: bool,
}

/// Pixels of one chart.
const SIZE: (u32, u32) = (500, 460);

/// All of them, side by side.
pub(crate) fn draw(path: &str, charts: &[Chart]) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all("target")?;
    let root = SVGBackend::new(path, (SIZE.0 * charts.len() as u32, SIZE.1)).into_drawing_area();
    root.fill(&WHITE)?;
    for (chart, area) in charts.iter().zip(root.split_evenly((1, charts.len()))) {
        chart.draw(&area)?;
    }
    root.present()?;
    println!("Drawn: {path}");
    Ok(())
}

impl Chart {
    fn draw(&self, area: &DrawingArea<SVGBackend<'_>, Shift>) -> Result<(), Box<dyn Error>> {
        let all = || self.curves.iter().flat_map(|curve| &curve.points);
        let (mut x, mut y) = (range(all().map(|point| point.0)), range(all().map(|point| point.1)));
        if let Some(limits) = &self.limits {
            y = limits.clone();
        } else if self.is_map {
            // The drawing is about as high as it is wide.
            let side = (x.end - x.start).max(y.end - y.start);
            [x, y] = [x, y].map(|range| {
                let middle = 0.5 * (range.start + range.end);
                middle - 0.5 * side..middle + 0.5 * side
            });
        }
        if self.curves.len() > 1 && self.limits.is_none() {
            // Room for the names.
            y.start -= 0.25 * (y.end - y.start);
        }
        let limits = y.clone();
        let mut chart = ChartBuilder::on(area)
            .caption(self.title, ("sans-serif", 17))
            .margin(14)
            .x_label_area_size(40)
            .y_label_area_size(55)
            .build_cartesian_2d(x, y)?;
        if let Some((from, to, what)) = self.band {
            let green = RGBColor(215, 238, 215);
            chart
                .draw_series([Rectangle::new([(from, limits.start), (to, limits.end)], green.filled())])?
                .label(what)
                .legend(move |(x, y)| Rectangle::new([(x, y - 5), (x + 18, y + 5)], green.filled()));
        }
        chart.configure_mesh().x_desc(self.axes[0]).y_desc(self.axes[1]).max_light_lines(0).draw()?;
        for curve in &self.curves {
            let colour = curve.colour;
            let points = curve.points.iter().copied().filter(|point| limits.contains(&point.1));
            if curve.is_dotted {
                let dots = points.map(|point| Circle::new(point, 2, colour.filled()));
                chart
                    .draw_series(dots)?
                    .label(curve.name)
                    .legend(move |(x, y)| Circle::new((x + 9, y), 3, colour.filled()));
            } else {
                chart
                    .draw_series(LineSeries::new(points, colour.stroke_width(2)))?
                    .label(curve.name)
                    .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2)));
            }
        }
        if self.curves.len() > 1 {
            let corner = if self.is_map { SeriesLabelPosition::LowerLeft } else { SeriesLabelPosition::LowerRight };
            let labels = &mut chart.configure_series_labels();
            labels.position(corner).background_style(WHITE).border_style(BLACK).draw()?;
        }
        Ok(())
    }
}

/// All values, with some room.
fn range(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
    let room = 0.05 * (high - low) + 1e-9;
    low - room..high + room
}
