//! Where the views stand on the sheet, their common scale, and their ticks.

use flexura_spatial::Vector3;

/// Height of a line of the legend, px.
pub const LEGEND_LINE: f64 = 19.0;
const LEGEND_WIDTH: f64 = 180.0;
/// Room for tick labels and axis name, px.
const LEFT: f64 = 72.0;
const BELOW: f64 = 64.0;
const TOP: f64 = 82.0;
/// The drawing itself, without labels, is at most this large, px.
const LARGEST: [f64; 2] = [840.0, 640.0];
/// The same of a view that stands alone.
const LARGEST_SINGLE: [f64; 2] = [640.0, 480.0];
/// The isometric view is at most so wide and high, px.
const LARGEST_ISOMETRIC: f64 = 460.0;
/// Extents below this part of the largest are none.
const FLAT: f64 = 1e-4;
/// Ticks are this far apart at least, px; closer where a narrow view would have too few.
const TICK_DISTANCE: f64 = 52.0;
const CLOSE_TICKS: f64 = 36.0;

/// One view.
pub struct Panel {
    /// Shown above it.
    pub title: &'static str,
    /// Which global axis runs across and which one up; None where none does.
    pub axes: Option<[usize; 2]>,
    /// Left, top, width, height in px.
    pub frame: [f64; 4],
    /// Unit vectors across, up, and towards the eye.
    rows: [Vector3<f64>; 3],
    low: [f64; 2],
    high: [f64; 2],
    scale: f64,
}

impl Panel {
    fn new(axes: [usize; 2], frame: [f64; 4], [low, high]: [Vector3<f64>; 2], scale: f64) -> Self {
        let (title, eye) = match axes {
            [0, 1] => ("top view (xy)", Vector3::z()),
            [0, _] => ("front view (xz)", -Vector3::y()),
            _ => ("side view (yz)", Vector3::x()),
        };
        let unit = |axis: usize| Vector3::from_fn(|row, _| if row == axis { 1.0 } else { 0.0 });
        Self {
            title,
            axes: Some(axes),
            frame,
            rows: [unit(axes[0]), unit(axes[1]), eye],
            low: axes.map(|axis| low[axis]),
            high: axes.map(|axis| high[axis]),
            scale,
        }
    }

    /// All three axes equally foreshortened, from above the front, in a frame no larger than `most` at no more than the given
    /// scale.
    fn isometric(
        [left, top]: [f64; 2],
        most: [f64; 2],
        [low, high]: [Vector3<f64>; 2],
        largest: f64,
    ) -> Self {
        let eye = Vector3::new(1.0, -1.0, 1.0).normalize();
        let across = Vector3::z().cross(&eye).normalize();
        let rows = [across, eye.cross(&across), eye];
        let corners = (0..8)
            .map(|i| Vector3::from_fn(|axis, _| if i >> axis & 1 == 0 { low[axis] } else { high[axis] }));
        let seen: Vec<[f64; 2]> =
            corners.map(|corner| [rows[0].dot(&corner), rows[1].dot(&corner)]).collect();
        let end = |side: usize, pick: fn(f64, f64) -> f64, from: f64| {
            seen.iter().map(|corner| corner[side]).fold(from, pick)
        };
        let low = [0, 1].map(|side| end(side, f64::min, f64::INFINITY));
        let high = [0, 1].map(|side| end(side, f64::max, f64::NEG_INFINITY));
        let size = [high[0] - low[0], high[1] - low[1]];
        let scale = largest.min(most[0] / size[0]).min(most[1] / size[1]);
        let frame = [left, top, scale * size[0], scale * size[1]];
        Self { title: "isometric view", axes: None, frame, rows, low, high, scale }
    }

    /// Where a point lies on the sheet.
    pub fn point(&self, point: &Vector3<f64>) -> [f64; 2] {
        [self.horizontal(self.rows[0].dot(point)), self.vertical(self.rows[1].dot(point))]
    }

    /// A direction on the sheet; shorter than 1 when it points out of the view.
    pub fn direction(&self, direction: &Vector3<f64>) -> [f64; 2] {
        [self.rows[0].dot(direction), -self.rows[1].dot(direction)]
    }

    /// Component of a direction towards the eye.
    pub fn depth(&self, direction: &Vector3<f64>) -> f64 {
        self.rows[2].dot(direction)
    }

    /// Does a place on the sheet lie within the view?
    pub fn holds(&self, [x, y]: [f64; 2]) -> bool {
        let [left, top, width, height] = self.frame;
        (left..=left + width).contains(&x) && (top..=top + height).contains(&y)
    }

    /// Pixel column of a coordinate across.
    pub fn horizontal(&self, value: f64) -> f64 {
        self.frame[0] + self.scale * (value - self.low[0])
    }

    /// Pixel row of a coordinate upwards.
    pub fn vertical(&self, value: f64) -> f64 {
        self.frame[1] + self.scale * (self.high[1] - value)
    }
}

/// The sheet.
pub struct Sheet {
    /// px.
    pub width: f64,
    /// px.
    pub height: f64,
    /// Left edge of the drawing, px.
    pub left: f64,
    /// Top view, front view, side view and an isometric one; or one plane alone.
    pub panels: Vec<Panel>,
    /// Top left corner of the legend, px.
    pub legend: [f64; 2],
    /// Unit of the tick labels.
    pub unit: &'static str,
    /// How many of that unit a metre is.
    per_metre: f64,
    /// Distance of ticks, m.
    step: f64,
}

impl Sheet {
    /// One view of a mechanism that stays in a plane, three planes and an isometric view of another.
    pub fn of(bounds: [Vector3<f64>; 2], legend_height: f64) -> Self {
        let extent = bounds[1] - bounds[0];
        let is_flat = |axis: usize| extent[axis] <= FLAT * extent.max();
        // Of a straight one, the view from the front.
        match [1, 2, 0].into_iter().find(|axis| is_flat(*axis)) {
            Some(1) => Self::single(bounds, [0, 2], legend_height),
            Some(2) => Self::single(bounds, [0, 1], legend_height),
            Some(_) => Self::single(bounds, [1, 2], legend_height),
            None => Self::new(bounds, (legend_height / LEGEND_LINE).ceil() as usize),
        }
    }

    /// Lays out the views of what lies between `low` and `high` (m).
    fn new([low, high]: [Vector3<f64>; 2], legend_lines: usize) -> Self {
        let (low, high, largest) = with_margins([low, high]);
        let size = high - low;
        let scale = (LARGEST[0] / (size.x + size.y)).min(LARGEST[1] / (size.y + size.z));
        let (width, depth, height) = (scale * size.x, scale * size.y, scale * size.z);

        let wide = nice_step(TICK_DISTANCE / scale);
        let step = if size.min() < 2.0 * wide { nice_step(CLOSE_TICKS / scale) } else { wide };

        let legend_height = LEGEND_LINE * legend_lines as f64;
        let second_column = LEFT + width + LEFT;
        let second_row = TOP + depth.max(legend_height) + BELOW;
        let panel = |axes, frame| Panel::new(axes, frame, [low, high], scale);
        let third_column = second_column + depth.max(LEGEND_WIDTH) + 36.0;
        let room = [LARGEST_ISOMETRIC, (second_row + height - TOP).min(LARGEST_ISOMETRIC)];
        let isometric = Panel::isometric([third_column, TOP], room, [low, high], scale);
        let width_of_all = third_column + isometric.frame[2] + 24.0;
        let panels = vec![
            panel([0, 1], [LEFT, TOP, width, depth]),
            panel([0, 2], [LEFT, second_row, width, height]),
            panel([1, 2], [second_column, second_row, depth, height]),
            isometric,
        ];
        let (unit, per_metre) = unit_for(largest);
        Self {
            width: width_of_all,
            height: second_row + height + 44.0,
            left: LEFT,
            panels,
            legend: [second_column, TOP],
            unit,
            per_metre,
            step,
        }
    }

    /// Lays out one view, beside a legend of that height, px.
    fn single(bounds: [Vector3<f64>; 2], axes: [usize; 2], legend_height: f64) -> Self {
        let (low, high, largest) = with_margins(bounds);
        let size = axes.map(|axis| high[axis] - low[axis]);
        let scale = (LARGEST_SINGLE[0] / size[0]).min(LARGEST_SINGLE[1] / size[1]);
        let (width, height) = (scale * size[0], scale * size[1]);
        let wide = nice_step(TICK_DISTANCE / scale);
        let is_narrow = size[0].min(size[1]) < 2.0 * wide;
        let (unit, per_metre) = unit_for(largest);
        let right = LEFT + width + 28.0;
        Self {
            width: right + LEGEND_WIDTH,
            height: TOP + height.max(legend_height) + 44.0,
            left: LEFT,
            panels: vec![Panel::new(axes, [LEFT, TOP, width, height], [low, high], scale)],
            legend: [right, TOP],
            unit,
            per_metre,
            step: if is_narrow { nice_step(CLOSE_TICKS / scale) } else { wide },
        }
    }

    /// Ticks of a panel across (side 0) or up (side 1): coordinate (m) and label.
    pub fn ticks(&self, side: usize, panel: &Panel) -> Vec<(f64, String)> {
        let first = (panel.low[side] / self.step).ceil() as i64;
        let last = (panel.high[side] / self.step).floor() as i64;
        let step = self.step * self.per_metre;
        let decimals = (-step.log10() - 1e-9).ceil().max(0.0) as usize;
        let label = |i: i64| if i == 0 { "0".to_owned() } else { format!("{:.decimals$}", i as f64 * step) };
        (first..=last).map(|i| (i as f64 * self.step, label(i).replace('-', "−"))).collect()
    }
}

/// The corners with a margin, and the largest extent without. A view that would be a bare line gets some height.
fn with_margins([low, high]: [Vector3<f64>; 2]) -> (Vector3<f64>, Vector3<f64>, f64) {
    let extent = high - low;
    let largest = if extent.max() > 0.0 { extent.max() } else { 1.0 };
    let middle = (low + high) * 0.5;
    let half = extent.map(|e| 0.5 * e.max(0.16 * largest) + 0.09 * largest);
    (middle - half, middle + half, largest)
}

/// The unit of lengths of this size, and how many of it a metre is.
fn unit_for(largest: f64) -> (&'static str, f64) {
    match largest {
        size if size >= 1e3 => ("km", 1e-3),
        size if size >= 1.0 => ("m", 1.0),
        size if size >= 1e-3 => ("mm", 1e3),
        size if size >= 1e-6 => ("µm", 1e6),
        _ => ("nm", 1e9),
    }
}

/// The smallest of 1, 2, 5 times a power of ten that is at least `least`.
pub fn nice_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|m| m * power).find(|step| *step >= least).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_one_two_or_five() {
        for (least, step) in [(0.9, 1.0), (1.1, 2.0), (2.0, 2.0), (3.0, 5.0), (0.06, 0.1)] {
            assert!((nice_step(least) - step).abs() < 1e-12, "{least}");
        }
    }

    #[test]
    fn a_plane_mechanism_has_one_view_and_another_four() {
        let titles = |high: Vector3<f64>| -> Vec<&str> {
            Sheet::of([Vector3::zeros(), high], 60.0).panels.iter().map(|panel| panel.title).collect()
        };
        assert_eq!(titles(Vector3::new(1.0, 0.0, 0.5)), ["front view (xz)"]);
        assert_eq!(titles(Vector3::new(1.0, 0.5, 0.0)), ["top view (xy)"]);
        assert_eq!(titles(Vector3::new(0.0, 1.0, 0.5)), ["side view (yz)"]);
        let all = ["top view (xy)", "front view (xz)", "side view (yz)", "isometric view"];
        assert_eq!(titles(Vector3::new(1.0, 0.5, 0.2)), all);
    }

    #[test]
    fn an_isometric_view_shortens_all_axes_alike_and_holds_the_box() {
        let (low, high) = (Vector3::new(-1.0, 0.0, 2.0), Vector3::new(3.0, 1.0, 2.5));
        let panel = Panel::isometric([10.0, 20.0], [300.0, 200.0], [low, high], 1e9);
        let lengths = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| {
            let [x, y] = panel.direction(&axis);
            x.hypot(y)
        });
        // sqrt(2/3), as in every textbook of drawing.
        assert!(lengths.iter().all(|length| (length - (2.0f64 / 3.0).sqrt()).abs() < 1e-12), "{lengths:?}");
        assert!(panel.holds(panel.point(&low)) && panel.holds(panel.point(&high)));
        assert!(panel.direction(&Vector3::z())[1] < 0.0 && panel.frame[2] <= 300.0 + 1e-9);
    }

    #[test]
    fn a_shape_without_any_extent_still_gets_a_sheet() {
        let sheet = Sheet::new([Vector3::zeros(); 2], 1);
        assert!(sheet.width.is_finite() && sheet.height < 2000.0);
    }
}
