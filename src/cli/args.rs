//! Verbs, options and their help.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Parser, Subcommand};
use hashed_alpha::check::subject::Precision;
use hashed_alpha::check::{Budget, Frames, Suite};
use hashed_alpha::render::gallery::GALLERY;
use hashed_alpha::render::scene_file::bound::LARGEST_SIDE;
use hashed_alpha::scene::Scene;
use hashed_alpha::shader::export::Language;
use hashed_alpha::shader::own::THRESHOLD;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::robust::{Join, Repair};
use hashed_alpha::threshold::two_scale::Variant;
use std::path::PathBuf;

/// The longest time that can be asked for, in hours: ten years.
const MOST_HOURS: f64 = 87_660.0;

const EXIT_CODES_AND_EXAMPLES: &str = "\
Exit codes:
  0  done; every claim is consistent with what was seen
  1  a claim was rejected that should hold
  2  a mistake in the arguments, a file or the input, or an error while reading or writing
  3  no verdict: a subject could not be tried

Examples:
  hashed-alpha check paper                       try every claim on the paper's listings
  hashed-alpha check robust                      the threshold with every repair
  hashed-alpha check paper:isotropic --json      one subject, one JSON object a claim
  hashed-alpha scenes fence | hashed-alpha eval  thresholds of a scene
  hashed-alpha eval --literal --trace rows.csv   every step of Listing 1
  hashed-alpha cost                              what accuracy costs in time";

/// Verifies the hashed alpha threshold of Wyman and McGuire (2017).
///
/// Hashed alpha testing discards a fragment when its alpha is below a threshold that is hashed from its place, so
/// that noise stays put when camera or object move. This program evaluates that threshold, tries the claims of the
/// paper on it with the evidence and the smallest defect that each trial would have detected, and writes a report.
/// Results go to stdout, progress to stderr.
#[derive(Debug, Parser)]
#[command(version, after_help = EXIT_CODES_AND_EXAMPLES, max_term_width = 100)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// One job.
#[derive(Debug, Subcommand)]
pub enum Verb {
    Check(CheckArgs),
    Compare(CompareArgs),
    Cost(CostArgs),
    Eval(EvalArgs),
    Explain(ExplainArgs),
    Grain(GrainArgs),
    Hashes(HashesArgs),
    Render(RenderArgs),
    Scenes(ScenesArgs),
    Shader(ShaderTextArgs),
}

/// Tries the claims on subjects and writes a report
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  hashed-alpha check
  hashed-alpha check paper robust
  hashed-alpha check paper:anisotropic --seed 7 --out report-7
  hashed-alpha check my.wgsl --suite paper
  hashed-alpha check my.glsl --function alpha_threshold --set hash_scale=2 --on device-model
  hashed-alpha check old.glsl#getThreshold new.wgsl#threshold --set old.glsl#u_scale=0.1,0.2,0.3
  hashed-alpha check paper --json --no-report | jq 'select(.verdict == \"rejected\")'
  hashed-alpha check my.glsl --format sarif --no-report > my.sarif
  hashed-alpha check paper --suite paper
  hashed-alpha check paper --only stability --only range --budget quick
  hashed-alpha check paper --expect findings.toml
  hashed-alpha check robust --until-failure --hours 0.5
  hashed-alpha check my.glsl --mend > my.diff && git apply my.diff
  hashed-alpha check hash:mm4 --until-failure --out report-mm4
  hashed-alpha check my.wgsl#my_hash --until-failure

A file of known findings makes the exit code speak of news alone:
  [[finding]]
  check = \"uniform.constant_z\"
  subject = \"paper:isotropic\"
  precision = \"f32\"
  reason = \"all cells of one z share a bias\"")]
pub struct CheckArgs {
    /// Subjects to try: `paper`, `robust`, or one variant of them as in `paper:isotropic`; the same on a device as in
    /// `gpu:robust`; a shader file (.wgsl, .glsl, .frag, .fsh, .spv, ... or between the quotes of a .js, .ts, .py, .h), with `#NAME` behind it
    /// for a function of it; `recommended` for the threshold that we recommend, in two presets; one hash alone as in `hash:mm4`, or as a shader's function from `vec4u` to `u32`. `robust` when none
    /// is given
    #[arg(value_name = "SUBJECT")]
    pub subjects: Vec<String>,
    #[command(flatten)]
    pub shader: ShaderArgs,
    /// Try the paper's listings to the letter: the same as the subject `paper`
    #[arg(long, conflicts_with = "subjects")]
    pub literal: bool,
    /// What to print: a table, JSON Lines, SARIF for a viewer of code, or commands for a workflow on GitHub, which show the cause
    /// at the line of the function
    #[arg(long, value_name = "FORMAT", default_value = "text", value_parser = one_of(Format::ALL, Format::name))]
    pub format: Format,
    /// Print JSON Lines in place of the table: the same as `--format json`
    #[arg(long, conflicts_with = "format")]
    pub json: bool,
    /// Seed of every random number of the run
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = seed, allow_negative_numbers = true)]
    pub seed: u64,
    /// Folder for the report
    #[arg(long, value_name = "DIR", default_value = "report")]
    pub out: PathBuf,
    /// Write no report
    #[arg(long, conflicts_with = "out")]
    pub no_report: bool,
    /// Which rejections count: `all`, or `paper`, where one that the paper's own listing is known for does not
    #[arg(long, default_value = "all", value_parser = one_of(Suite::ALL, Suite::name))]
    pub suite: Suite,
    /// How many samples are drawn: `quick` for a quarter, `nightly` for sixteen times as many
    #[arg(long, default_value = "ci", value_parser = one_of(Budget::ALL, Budget::name))]
    pub budget: Budget,
    /// Try only this claim, or the family of this name; can be given several times
    #[arg(long, value_name = "CLAIM")]
    pub only: Vec<String>,
    /// TOML file of findings that are known and do not count as rejected
    #[arg(long, value_name = "FILE")]
    pub expect: Option<PathBuf>,
    /// Pass over shader files that have no such function and no hashed test of an alpha, and try the others where one cannot be read; the
    /// exit code is 2 where one could not
    #[arg(long)]
    pub keep_going: bool,
    /// Write the smallest change of a shader file (GLSL, WGSL) after which its slips are gone and every claim holds that the paper's own
    /// listing passes, as a unified diff on stdout; it was tried before it is written. Exit code 1 where none is found, 0 with a diff and where
    /// nothing is to mend
    #[arg(long, conflicts_with_all = ["literal", "format", "json", "suite", "only", "expect", "until_failure", "out", "no_report", "keep_going"])]
    pub mend: bool,
    /// Double the samples of every claim until it fails, and say at which number. The verdict is valid whenever one stops; what
    /// is known is kept in the folder of the report, and the same command goes on from there. Ctrl-C ends with what is known
    #[arg(long, conflicts_with_all = ["suite", "expect", "no_report"])]
    pub until_failure: bool,
    /// End after so many hours, as in 0.5
    #[arg(long, value_name = "H", requires = "until_failure", value_parser = hours)]
    pub hours: Option<f64>,
    /// Double the samples no more than K times
    #[arg(long, value_name = "K", requires = "until_failure", value_parser = clap::value_parser!(u32).range(0..=63))]
    pub doublings: Option<u32>,
}

/// What a verdict is written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// A table for a terminal.
    #[default]
    Text,
    /// JSON Lines, one object a claim.
    Json,
    /// SARIF 2.1.0.
    Sarif,
    /// Commands of a workflow on GitHub.
    Github,
}

impl Format {
    const ALL: [Self; 4] = [Self::Text, Self::Json, Self::Sarif, Self::Github];

    /// The word by which it is asked for.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::Json => "json",
            Self::Sarif => "sarif",
            Self::Github => "github",
        }
    }
}

impl CheckArgs {
    /// The format that was asked for in either way.
    pub fn written_in(&self) -> Format {
        if self.json { Format::Json } else { self.format }
    }
}

/// Where a shader runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum On {
    /// On the GPU if there is one, in the interpreter otherwise.
    #[default]
    Auto,
    /// On the GPU.
    Gpu,
    /// In the interpreter, with correctly rounded functions.
    Cpu,
    /// In the interpreter, under every model of a device.
    DeviceModel,
}

impl On {
    const ALL: [Self; 4] = [Self::Auto, Self::Gpu, Self::Cpu, Self::DeviceModel];

    const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Gpu => "gpu",
            Self::Cpu => "cpu",
            Self::DeviceModel => "device-model",
        }
    }
}

/// What a shader file is meant to be; one that `shader` has written says so itself, where none of these is stated
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct ClaimArgs {
    /// Which listing a shader file follows; isotropic, as Listing 1, unless stated
    #[arg(long, value_parser = one_of(Variant::ALL, Variant::name))]
    pub variant: Option<Variant>,
    /// How a shader file joins the hashes of two octaves; interpolate, as the paper, unless stated
    #[arg(long, value_parser = one_of(Join::ALL, Join::name))]
    pub join: Option<Join>,
    /// Size of the noise in pixels that a shader file is meant to have, above 0; 1, or what --set hash_scale gives
    #[arg(long, value_name = "S", value_parser = size, allow_negative_numbers = true)]
    pub hash_scale: Option<f64>,
    /// A shader file cuts its cells between whole numbers, as the robust threshold does
    #[arg(long)]
    pub nested_phase: bool,
}

impl ClaimArgs {
    /// What holds where nothing was typed.
    pub const UNSTATED: Self = Self { variant: None, join: None, hash_scale: None, nested_phase: false };

    /// Reads the options of one line.
    pub fn read(line: &str) -> Option<Self> {
        #[derive(clap::Parser)]
        #[command(no_binary_name = true)]
        struct Line {
            #[command(flatten)]
            claims: ClaimArgs,
        }
        <Line as clap::Parser>::try_parse_from(line.split_whitespace()).ok().map(|line| line.claims)
    }
}

/// How shader files are read and run
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Shaders")]
pub struct ShaderArgs {
    /// Function of the shader files that returns the threshold, or that has the test of an alpha: one that discards, that returns
    /// whether to keep, or `main`. That of one file is named as in `my.glsl#NAME`. Without one, the only function that sounds like it is
    /// taken
    #[arg(long, value_name = "NAME", default_value = THRESHOLD)]
    pub function: String,
    /// Value of a parameter, uniform, override or macro of the shader files; a vector is X,Y,Z. FILE#KEY=VALUE for one file
    /// among several. Can be given several times
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// What a shader file calls a value of the fragment, as in position=wpos where a parameter, varying, uniform or member `wpos` holds
    /// the position, or alpha=a where `a` is tested. The usual names (pos, vPosition, uv, gl_FragCoord, ...) are known. FILE#KEY=NAME for
    /// one file among several
    #[arg(long, value_name = "KEY=NAME")]
    pub map: Vec<String>,
    /// Folder in which files are looked for that an `#include` of GLSL or HLSL names, behind that of the file itself. Can be given
    /// several times
    #[arg(short = 'I', long, value_name = "DIR")]
    pub include: Vec<PathBuf>,
    /// Where a shader runs: `auto` is the GPU if there is one and the interpreter otherwise, `device-model` is the interpreter
    /// under the arithmetic of several devices
    #[arg(long, default_value = "auto", value_parser = one_of(On::ALL, On::name))]
    pub on: On,
    /// Index of a GPU or part of its name; also in the variable HASHED_ALPHA_ADAPTER
    #[arg(long, value_name = "GPU")]
    pub adapter: Option<String>,
    #[command(flatten)]
    pub claims: ClaimArgs,
    /// Over how many frames a shader file spreads its thresholds (Eq. 6), or `sequence` where it goes through a sequence of frames,
    /// as by fract(threshold + frame * 0.618034)
    #[arg(long, value_name = "N", default_value = "1", allow_negative_numbers = true)]
    pub frames: Frames,
}

/// Compares two subjects: are their thresholds equal, or of one law?
///
/// Values are compared in bits, laws on samples that share no cell. What rests on the sine of large arguments can have the
/// same law on two machines, never the same values. Exit code 1 where the laws differ.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  hashed-alpha compare paper robust
  hashed-alpha compare cpu:robust gpu:robust
  hashed-alpha compare paper:isotropic my.wgsl")]
pub struct CompareArgs {
    /// A subject, as for `check`
    #[arg(value_name = "A")]
    pub first: String,
    /// Another one
    #[arg(value_name = "B")]
    pub second: String,
    #[command(flatten)]
    pub shader: ShaderArgs,
    /// Seed of every random number of the run
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = seed, allow_negative_numbers = true)]
    pub seed: u64,
    /// How many samples are drawn: `quick` for a quarter, `nightly` for sixteen times as many
    #[arg(long, default_value = "ci", value_parser = one_of(Budget::ALL, Budget::name))]
    pub budget: Budget,
}

/// Measures how grainy a threshold looks, and how much of it changes
///
/// Grain is the power of the picture of what is visible below 1/16 of a cycle a pixel, divided by alpha (1 - alpha): 1 for noise
/// without order, less for noise that the eye averages away, more for clumps. Beside it stand the shares of pixels that appear or
/// vanish in 1/8 of a pixel of motion and in an octave of zoom, the greatest share of a surface that a small motion of the camera changes
/// at once, and how long runs of pixels are at grazing angles.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  hashed-alpha grain robust:isotropic recommended
  hashed-alpha grain my.wgsl --json")]
pub struct GrainArgs {
    /// Subjects, as for `check`
    #[arg(value_name = "SUBJECT", required = true)]
    pub subjects: Vec<String>,
    #[command(flatten)]
    pub shader: ShaderArgs,
    /// Seed of every random number of the run
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = seed, allow_negative_numbers = true)]
    pub seed: u64,
    /// One JSON object a row in place of the table
    #[arg(long)]
    pub json: bool,
}

/// Lists the hashes, or measures each: how good, how fast, how steady
///
/// `samples to failure` are those of the first claim that rejects a hash alone, or the most that none rejects; grain, flips and operations
/// are those of the robust threshold with one scale, times the fastest rounds of a run in which all hashes take turns. What is
/// known is written to the folder of the report after each hash.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  hashed-alpha hashes
  hashed-alpha hashes --measure                            every hash, some ten minutes
  hashed-alpha hashes mm4 lowbias-linear --measure --doublings 2
  hashed-alpha check hash:mm4 --until-failure              one hash, claim by claim")]
pub struct HashesArgs {
    /// Which; all when none is given
    #[arg(value_name = "HASH", value_parser = one_of(HashKind::ALL, HashKind::name))]
    pub hashes: Vec<HashKind>,
    /// Measure them
    #[arg(long)]
    pub measure: bool,
    /// Double the samples of a claim no more than K times
    #[arg(long, value_name = "K", default_value_t = 3, requires = "measure", value_parser = clap::value_parser!(u32).range(0..=16))]
    pub doublings: u32,
    /// Take the time of few rounds
    #[arg(long, requires = "measure")]
    pub quick: bool,
    /// Folder for what was measured
    #[arg(long, value_name = "DIR", default_value = "report")]
    pub out: PathBuf,
    /// Page of which the table between `<!-- hashes -->` and `<!-- end of hashes -->` is written anew; the figure and the numbers are
    /// written beside it
    #[arg(long, value_name = "FILE", requires = "measure", conflicts_with_all = ["hashes", "quick"])]
    pub page: Option<PathBuf>,
    /// One JSON object a hash in place of the table
    #[arg(long, requires = "measure")]
    pub json: bool,
}

/// Measures what accuracy costs in time
///
/// All tiers are timed in one run, in turns, on one thread and fresh inputs. `ratio` says how many times faster than Listing 1
/// written in Rust with the sine of the standard library. `error` is the greatest distance to the exact value for sine and
/// logarithm, and the mean distance to the formula over real numbers for hashes and thresholds: 0.33 is that of two random
/// numbers. `flips` and `zoom flips` count how often a fragment appears or vanishes in a pixel of motion and an octave of zoom.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  hashed-alpha cost                       every tier of sine, hash and threshold; report/cost.svg answers in one picture
  hashed-alpha cost --quick --out /dev/shm/cost
  hashed-alpha cost --json | jq -c 'select(.name == \"literal\") | [.tier, .isa, .ratio, .bits_equal]'
  hashed-alpha cost --effects             what each effect of the paper adds, and Table 1 beside it
  hashed-alpha cost --effects --adapter nvidia
  hashed-alpha cost --sizes               time and memory of 10^4 to 10^9 samples, on 1 and 2 threads
  hashed-alpha cost --sizes --samples 10000000000
  hashed-alpha cost --drawing             time of a frame of up to 80 000 triangles and 1920 x 1080 pixels")]
pub struct CostArgs {
    /// Measure effects: fixed, stochastic, hashed, fade-in, stratification, coverage; on the CPU and on the device
    #[arg(long, conflicts_with = "sizes")]
    pub effects: bool,
    /// Index of a GPU or part of its name; also in the variable HASHED_ALPHA_ADAPTER
    #[arg(long, value_name = "GPU", requires = "effects")]
    pub adapter: Option<String>,
    /// Measure time and memory against the number of samples, on 1 and 2 threads
    #[arg(long)]
    pub sizes: bool,
    /// One number of samples in place of all powers of ten
    #[arg(long, value_name = "N", requires = "sizes", value_parser = clap::value_parser!(u64).range(1..=1_000_000_000_000))]
    pub samples: Option<u64>,
    /// Measure the time of a frame against triangles and pixels, with and without rays, on all threads
    #[arg(long, conflicts_with_all = ["effects", "sizes"])]
    pub drawing: bool,
    /// Write the table into this page, too, between its lines `<!-- cost -->` and `<!-- end of cost -->`, and the first picture beside
    /// it; with --drawing between `<!-- cost --drawing -->` and `<!-- end of cost --drawing -->`
    #[arg(long, value_name = "FILE", conflicts_with_all = ["effects", "sizes"])]
    pub page: Option<PathBuf>,
    /// A few seconds, to see that all of it works; the figures are rough
    #[arg(long)]
    pub quick: bool,
    /// Write one JSON object a row in place of the table
    #[arg(long)]
    pub json: bool,
    /// Folder for tables and pictures
    #[arg(long, value_name = "DIR", default_value = "report")]
    pub out: PathBuf,
}

/// Prints the verified threshold in a shading language
///
/// A library function called `threshold`, without an entry point: paste it in front of the shader that calls it. A header says
/// what it is and how it is called.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  hashed-alpha shader > threshold.wgsl
  hashed-alpha shader --lang hlsl --variant anisotropic
  hashed-alpha shader --lang spirv --out threshold.spv
  hashed-alpha shader --lang wgsl --out mine.wgsl && hashed-alpha check mine.wgsl")]
pub struct ShaderTextArgs {
    /// Shading language
    #[arg(long, default_value = "wgsl", value_parser = one_of(Language::ALL, Language::name))]
    pub lang: Language,
    /// How scales are chosen from the derivatives
    #[arg(long, default_value = "isotropic", value_parser = one_of(Variant::ALL, Variant::name))]
    pub variant: Variant,
    /// What gives a cell its value; lowbias-linear unless stated, sine as in the paper with --literal
    #[arg(long, value_parser = one_of(HashKind::ALL, HashKind::name))]
    pub hash: Option<HashKind>,
    /// How the hashes of two octaves become one value; unless stated inherit, and copula for anisotropic
    #[arg(long, value_parser = one_of(Join::ALL, Join::name))]
    pub join: Option<Join>,
    /// Size of the noise in pixels, above 0
    #[arg(long, value_name = "S", default_value_t = 1.0)]
    pub hash_scale: f32,
    /// Make the size of the noise a parameter of the function
    #[arg(long, conflicts_with = "hash_scale")]
    pub hash_scale_parameter: bool,
    /// Follow the listings to the letter, with their division by zero
    #[arg(long)]
    pub literal: bool,
    /// File to write; standard output when none is given
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// Computes the threshold of every footprint of a CSV file
///
/// A row holds a position and its two screen derivatives: px,py,pz,dxx,dxy,dxz,dyx,dyy,dyz. A first line with these
/// names is allowed; empty lines and lines that start with # are skipped. One line is written for every row.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  echo 0.3,-1.7,2.4,0.012,0,0,0,0.009,0.003 | hashed-alpha eval
  hashed-alpha eval --variant anisotropic --join dithered --precision f64 rows.csv
  hashed-alpha eval --literal rows.csv
  hashed-alpha scenes fence | hashed-alpha eval --trace > trace.csv")]
pub struct EvalArgs {
    /// File to read; - is standard input
    #[arg(value_name = "FILE", default_value = "-")]
    pub file: PathBuf,
    /// How scales are chosen from the derivatives
    #[arg(long, default_value = "isotropic", value_parser = one_of(Variant::ALL, Variant::name))]
    pub variant: Variant,
    /// What gives a cell its value; lowbias-linear unless stated, sine as in the paper with --literal, linear and single
    #[arg(long, value_parser = one_of(HashKind::ALL, HashKind::name))]
    pub hash: Option<HashKind>,
    /// How the hashes of two octaves become one value; unless stated inherit, and copula for anisotropic
    #[arg(long, value_parser = one_of(Join::ALL, Join::name))]
    pub join: Option<Join>,
    /// Leave out one repair of the robust threshold; can be given several times
    #[arg(long, value_name = "REPAIR", value_parser = one_of(Repair::ALL, Repair::name))]
    pub without: Vec<Repair>,
    /// Type in which input is read and everything computed
    #[arg(long, default_value = "f32", value_parser = one_of(Precision::ALL, Precision::name))]
    pub precision: Precision,
    /// Size of the noise in pixels, above 0
    #[arg(long, value_name = "S", default_value_t = 1.0, allow_negative_numbers = true)]
    pub hash_scale: f64,
    /// Follow the listings to the letter, with their division by zero, in place of the robust threshold
    #[arg(long)]
    pub literal: bool,
    /// Write every step in place of the threshold alone
    #[arg(long)]
    pub trace: bool,
}

/// Which scene, and what of it is different this time
#[derive(Debug, clap::Args)]
pub struct SceneArgs {
    /// Scene files (TOML), or names of scenes of the render gallery; `gallery` is all of those
    #[arg(value_name = "SCENE", required = true)]
    pub scenes: Vec<String>,
    /// Width and height of the image in pixels; by default those of the scene
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = resolution)]
    pub resolution: Option<[u32; 2]>,
    /// Number of frames; by default that of the scene
    #[arg(long, value_name = "N")]
    pub frames: Option<core::num::NonZeroU32>,
    /// Seed of every random number; by default that of the scene
    #[arg(long, value_name = "N", value_parser = seed, allow_negative_numbers = true)]
    pub seed: Option<u64>,
}

/// Says what a scene will simulate: stages, what they need, what they cost, and what will not run
///
/// Only the effects run whose tables the scene file has. Costs are counted quantities; `render` counts the same ones while
/// it draws.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  hashed-alpha explain grazing-fence
  hashed-alpha explain my-scene.toml --shader")]
pub struct ExplainArgs {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Print the threshold of each take as WGSL, too
    #[arg(long)]
    pub shader: bool,
}

/// Draws scenes, measures the pictures and checks what the scenes expect of them
///
/// Writes NAME.png (the takes side by side, the truth last, then enlarged insets and differences), NAME.json, NAME.csv and,
/// of scenes with several distances, NAME-distance.svg (coverage against distance). Exit code 1 where a scene does not show what it must.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  hashed-alpha render grazing-fence
  hashed-alpha render gallery --out pictures
  hashed-alpha scenes grazing-fence > mine.toml && hashed-alpha render mine.toml --sequence")]
pub struct RenderArgs {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Folder for pictures and numbers
    #[arg(long, value_name = "DIR", default_value = "render")]
    pub out: PathBuf,
    /// Write the frames of each take as an animated PNG, too
    #[arg(long)]
    pub sequence: bool,
    /// Print one JSON object a scene in place of the table
    #[arg(long)]
    pub json: bool,
}

/// Lists the built-in scenes, or prints one
///
/// Those marked `rows` are printed as CSV, those marked `file` as a scene file to start from, for `explain` and `render`. Footprints come in the form that `eval` reads: pixels row by row, and in each pixel the surfaces that it sees.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  hashed-alpha scenes
  hashed-alpha scenes fence --resolution 64x48 | hashed-alpha eval
  hashed-alpha scenes wall --quads > rows.csv
  hashed-alpha scenes grazing-fence > mine.toml")]
pub struct ScenesArgs {
    /// Scene to print; all are listed when none is given
    #[arg(value_name = "NAME", value_parser = scene_names())]
    pub name: Option<String>,
    /// Type to which the numbers are rounded
    #[arg(long, default_value = "f32", requires = "name", value_parser = one_of(Precision::ALL, Precision::name))]
    pub precision: Precision,
    /// Take derivatives as a GPU does: differences of f32 positions in 2x2 quads of pixels
    #[arg(long, requires = "name")]
    pub quads: bool,
    /// Width and height of the image in pixels; by default those of the scene
    #[arg(long, value_name = "WIDTHxHEIGHT", requires = "name", value_parser = resolution)]
    pub resolution: Option<[u32; 2]>,
}

/// Accepts the names of `all`, lists them in the help and suggests the nearest one.
fn one_of<T, const N: usize>(all: [T; N], name: fn(T) -> &'static str) -> impl TypedValueParser<Value = T>
where
    T: Copy + Send + Sync + 'static,
{
    let find = move |typed: String| all.into_iter().find(|&item| name(item) == typed).ok_or("unknown name");
    PossibleValuesParser::new(all.map(name)).try_map(find)
}

fn scene_names() -> PossibleValuesParser {
    let drawn = GALLERY.iter().map(|entry| entry.name);
    PossibleValuesParser::new(Scene::all().into_iter().map(|scene| scene.name).chain(drawn))
}

/// Reads a width and a height in pixels, as in `640x480`.
fn resolution(text: &str) -> Result<[u32; 2], String> {
    let size =
        text.split_once('x').and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    size.filter(|size| size.iter().all(|side| (1..=LARGEST_SIDE).contains(side))).ok_or_else(|| {
        format!("write width and height in pixels like 640x480, each from 1 to {LARGEST_SIDE}")
    })
}

/// Reads a size of the noise.
fn size(text: &str) -> Result<f64, &'static str> {
    let size = text.parse().ok().filter(|&size: &f64| (size as f32).is_finite() && size as f32 > 0.0);
    size.ok_or("a size of the noise is a number of pixels above 0")
}

/// Reads a time in hours.
fn hours(text: &str) -> Result<f64, String> {
    let hours = text.parse().ok().filter(|hours: &f64| *hours > 0.0 && *hours <= MOST_HOURS);
    hours.ok_or_else(|| format!("a time is a number of hours above 0, up to {MOST_HOURS}"))
}

/// Reads a seed.
fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("a seed is a whole number from 0 to {}", u64::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn every_definition_is_sound() {
        Args::command().debug_assert();
    }

    #[test]
    fn eval_defaults_to_the_robust_threshold_of_one_scale() {
        let args = Args::try_parse_from(["hashed-alpha", "eval"]).unwrap();
        let Verb::Eval(eval) = args.verb else { panic!("{args:?}") };
        assert_eq!((eval.variant, eval.hash, eval.literal), (Variant::Isotropic, None, false));
        assert_eq!((eval.precision, eval.hash_scale), (Precision::F32, 1.0));
    }

    #[test]
    fn every_name_of_the_catalogue_is_accepted() {
        for kind in HashKind::ALL {
            assert!(Args::try_parse_from(["hashed-alpha", "eval", "--hash", kind.name()]).is_ok(), "{kind}");
        }
        for variant in Variant::ALL {
            assert!(Args::try_parse_from(["hashed-alpha", "eval", "--variant", variant.name()]).is_ok());
        }
    }
}
