//! Where a result is shown besides: a page, and still pictures.

use crate::arguments::ShownArguments;
use crate::failure::Failure;
use crate::{files, page, screen};
use flexura::model::visible;
use flexura::output::stacked;
use flexura::raster;
use std::path::{Path, PathBuf};

/// Pixels of a PNG for each unit of the drawing: letters of eleven units stay sharp.
const PIXELS: f64 = 2.0;

/// Files that were asked for by their names.
#[derive(Default)]
pub struct Shown {
    page: Option<PathBuf>,
    svg: Option<PathBuf>,
    png: Option<PathBuf>,
    is_live: bool,
}

impl Shown {
    /// Refuses what could not be written in the end; `has_folder` says that a page is written into a folder besides.
    pub fn new(arguments: &ShownArguments, has_folder: bool) -> Result<Self, Failure> {
        let ShownArguments { report: page, live: is_live, svg, png } = arguments.clone();
        if is_live && page.is_none() && !has_folder {
            return Err(Failure::Input(
                "--live puts the solver into a page; say where to write that: --report FILE".to_owned(),
            ));
        }
        let shown = Self { page, svg, png, is_live };
        shown.paths().try_for_each(page::begin)?;
        Ok(shown)
    }

    /// Still pictures alone.
    pub fn still(svg: Option<PathBuf>, png: Option<PathBuf>) -> Result<Self, Failure> {
        let shown = Self { svg, png, ..Self::default() };
        shown.paths().try_for_each(page::begin)?;
        Ok(shown)
    }

    /// The page of a result document, as it was asked for.
    pub fn page_of(&self, document: &str) -> Result<String, Failure> {
        page::of_text(document, self.is_live)
    }

    fn paths(&self) -> impl Iterator<Item = &Path> {
        [&self.page, &self.svg, &self.png].into_iter().flatten().map(PathBuf::as_path)
    }

    /// Is anything wanted at all?
    pub fn is_wanted(&self) -> bool {
        self.paths().next().is_some()
    }

    /// Is a page wanted?
    pub fn wants_page(&self) -> bool {
        self.page.is_some()
    }

    /// Is a still picture wanted?
    pub fn wants_picture(&self) -> bool {
        self.svg.is_some() || self.png.is_some()
    }

    /// Writes the page of a result document, and pictures (SVG) on one sheet.
    pub fn write(&self, document: Option<&str>, pictures: &[String]) -> Result<(), Failure> {
        if let (Some(path), Some(document)) = (&self.page, document) {
            files::replace(path, self.page_of(document)?)?;
        }
        if pictures.is_empty() || !self.wants_picture() {
            return Ok(());
        }
        let sheet = stacked(pictures);
        if let Some(path) = &self.svg {
            files::replace(path, &sheet)?;
        }
        if let Some(path) = &self.png {
            let bytes = raster::png(&sheet, PIXELS).map_err(|error| Failure::Machine(error.to_string()))?;
            files::replace(path, &bytes)?;
        }
        Ok(())
    }

    /// Says what was written.
    pub fn tell(&self) {
        for path in self.paths() {
            screen::note(&format!("wrote {}", visible(&path.to_string_lossy())));
        }
    }
}
