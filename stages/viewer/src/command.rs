//! Everything that a key, a click, a drag or a button does, as a value.

use crate::element_walk::ElementKind;
use crate::picture_pair::PairView;
use crate::report::CasePart;
use crate::session::Mode;
use crate::settings::Change;
use crate::tree_walk::Side;
use kit::Vec2;
use kit::film::Cell;
use std::path::PathBuf;

/// A command.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Switches to a mode. A render goes on in the background.
    Mode(Mode),
    /// Switches to render mode and starts a render, from the beginning.
    Render,
    /// Rotates the camera about its target, in fractions of the view's height.
    Orbit(Vec2),
    /// Moves the camera along the film, in fractions of the view's height.
    Pan(Vec2),
    /// Moves the camera towards its target, in steps of the wheel.
    Zoom(f64),
    /// Returns to the view at the start.
    ResetView,
    /// Shows or hides the edges of triangles.
    ToggleEdges,
    /// Cuts the scene of the view open across the next axis, or no longer.
    NextCut,
    /// Shows the other side of the cut.
    FlipCut,
    /// Moves the plane of the cut to a coordinate.
    MoveCut(f64),
    /// Selects what is under the pointer, or nothing.
    Select,
    /// Selects the next vertex, edge or face, or the previous one.
    SelectNext {
        /// What to select.
        kind: ElementKind,
        /// Forward, else back.
        forward: bool,
    },
    /// Moves the selected vertex, in fractions of the view's width and height.
    MoveVertex(Vec2),
    /// As [`Command::MoveVertex`], as a whole move.
    NudgeVertex(Vec2),
    /// The vertex is where it should be: the next move is another one.
    EndMove,
    /// Moves the vertex back that was moved last.
    UndoMove,
    /// Moves the vertex again that was moved back last.
    RedoMove,
    /// Selects a child of the node.
    Descend(Side),
    /// Selects the parent of the node.
    Ascend,
    /// Selects the node at a depth of the tree.
    GoToDepth(usize),
    /// Selects a node.
    GoToNode(u32),
    /// Shows the boxes of the wide tree, or those of the binary one.
    ToggleWideTree,
    /// Changes the camera rays per pixel.
    Samples(Change),
    /// Changes the samples per light.
    LightSamples(Change),
    /// Changes the ray depth.
    Depth(Change),
    /// Switches uniform sampling of the hemisphere on or off.
    ToggleHemisphere,
    /// Switches multiple importance sampling on or off.
    ToggleMis,
    /// Switches adaptive sampling on or off.
    ToggleAdaptive,
    /// Selects the next distribution of samples.
    NextSampler,
    /// Switches cell mode on or off. Off also forgets the cell.
    ToggleCell,
    /// Renders only this cell.
    SetCell(Cell),
    /// Stops the render, or resumes it.
    StopOrResume,
    /// Renders as many samples again.
    AddSamples,
    /// Shows the number of samples of each pixel, or the picture.
    ToggleRate,
    /// Shows the heat map of box tests, then of primitive tests, then the picture.
    NextHeat,
    /// Shows the luminance of the picture in false colours, or the picture.
    ToggleFalseColor,
    /// Shows a layer of the picture file, by its place, or its picture.
    ShowLayer(Option<usize>),
    /// Inspects the pixel with the most tests.
    GoToCostliest,
    /// Keeps the picture, to compare later ones with it.
    KeepForComparison,
    /// Reads a picture file to compare with.
    CompareWith(PathBuf),
    /// Ends the comparison.
    EndComparison,
    /// Shows both pictures in turns, or side by side.
    Flicker,
    /// Shows two pictures in another way.
    ShowPair(PairView),
    /// Shows two pictures in the next way.
    NextPairView,
    /// Compares with the next of the kept pictures.
    NextCompared,
    /// Swaps the compared pictures.
    SwapCompared,
    /// Replays a pixel, counted from the bottom left.
    Inspect(u32, u32),
    /// Replays the pixel beside the replayed one, by columns and rows; without a replay that in the
    /// middle.
    InspectNext(i32, i32),
    /// Replays the pixel under the pointer.
    InspectUnderPointer,
    /// Walks through the tests of the ray.
    StepTest {
        /// Forward, else back.
        forward: bool,
    },
    /// Walks from ray to ray.
    StepRay {
        /// Forward, else back.
        forward: bool,
    },
    /// Selects a sample of the replay.
    SelectSample(usize),
    /// Selects a ray of the sample.
    SelectRay(usize),
    /// Selects a test of the ray.
    SelectTest(usize),
    /// Saves the selected ray as a Rust test.
    SaveRayAsTest,
    /// Forgets the replay.
    CloseInspector,
    /// Saves the picture or the view.
    Screenshot,
    /// Writes the camera to a file.
    DumpCamera,
    /// Shows or hides the text in the view.
    ToggleOverlay,
    /// Switches between light and dark.
    ToggleTheme,
    /// Shows or hides the list of keys.
    ToggleHelp,
    /// Keeps the camera.
    KeepCamera,
    /// Goes to the next of the kept cameras.
    NextKeptCamera,
    /// Goes to a kept camera, by its place among all.
    GoToKeptCamera(usize),
    /// Forgets a kept camera, by its place among all.
    ForgetCamera(usize),
    /// Reads a camera file.
    LoadCamera(PathBuf),
    /// Asks which file to open.
    ChooseFile,
    /// Opens the file whose path was typed, or saves the scene to it.
    UseTypedPath,
    /// Asks for a path to save the scene to.
    SaveScene,
    /// Opens a scene file.
    Open(PathBuf),
    /// Reads the scene file again.
    Reload,
    /// Closes the text about a scene that was not loaded.
    CloseProblem,
    /// Switches to report mode; there already, shows the next part of the case.
    ShowReport,
    /// Opens a case of the report.
    OpenCase(usize),
    /// Opens the next case of the report, or the previous one.
    NeighbourCase {
        /// Forward, else back.
        forward: bool,
    },
    /// Shows a part of the case.
    ShowPart(CasePart),
    /// Walks to an event of the case, counted from 1.
    GoToEvent(usize),
    /// Go to the event with this number and look at it.
    FrameEvent(usize),
    /// Saves the test of the opened case.
    SaveCaseAsTest,
    /// Closes the list of keys; else asks to close the window.
    Escape,
    /// Saves the picture in progress and closes the window.
    SaveAndQuit,
    /// Closes the window.
    Quit,
    /// Does not close the window.
    DoNotQuit,
}

impl Command {
    /// Opens a file: a scene, a camera, else a picture.
    pub fn for_file(path: PathBuf) -> Command {
        let is = |end: &str| {
            path.extension()
                .is_some_and(|e| e.eq_ignore_ascii_case(end))
        };
        if is("dae") {
            Command::Open(path)
        } else if is("txt") {
            Command::LoadCamera(path)
        } else {
            Command::CompareWith(path)
        }
    }
}
