//! The binary as a user meets it: streams, exit codes, messages, and the numbers of `eval`.

use hashed_alpha::shader::own;
use std::fs::File;
use std::io::{BufRead, BufReader, Seek, Write};
use std::process::{Command, Output, Stdio};

/// Footprints under the letters by which [`STAGES`] names them.
const ROWS: [(&str, &str); 6] = [
    ("a", "0.31,-1.72,2.43,0.0121,0.0003,-0.0007,0.0002,0.0094,0.0033"),
    ("b", "-7.5,0.001,12.25,0.3,0,0.8,0.1,0.3,-0.2"),
    ("c", "100.125,-250.5,3.75,3.5,-1.25,0.7,0.6,2.5,-4.1"),
    ("d", "0.001,0.002,-0.003,1e-5,2e-5,-3e-6,4e-6,-1e-5,2.5e-5"),
    ("e", "0.3,0.4,-0.5,0.25,0,0,0.1,0.2,0.05"),
    ("f", "1,2,3,2.2,0.3,0.1,0.5,1.7,-0.9"),
];

/// What a separate Python program makes of [`ROWS`]: every stage by mpmath with 200 bits, out of the stage before as
/// rounded by IEEE arithmetic in the precision on trial, and the hash by the package mmh3, in units of 2^-24.
///
/// A block opens with variant, precision and hash scale. A row holds the columns of `--trace`.
const STAGES: &str = "\
isotropic f32 1
a: 0.01212394319 82.48141506 6 0.3659971742 1823267 13679153 0.3673129938 0.2907153937
b: 0.8544003899 1.170411442 0 0.22701581 3436591 1093167 0.1731274549 0.08540340654
c: 4.839421375 0.2066362781 -3 0.7251654803 9397045 16333739 0.8599338085 0.9507815589
d: 0.0000272213145 36735.91861 15 0.1649037051 11491943 11790235 0.6879050992 0.7250101209
e: 0.25 4.0 2 0.0 633741 633741 0.03777390718 0.03777390718
isotropic f64 1.5
a: 0.01212394325291899374 54.98761028151118462 5 0.781034684451809036 32855 1823267 0.08530788847558094739 0.02127662510735587752
b: 0.8544003745317531545 0.7802743146408703366 -1 0.642053314726197468 10396237 3436591 0.3533228168713497071 0.2715963538225634026
c: 4.839421453025144106 0.1377575136073197996 -3 0.1402029139155987062 9397045 16333739 0.6180757112348586295 0.6373297411050632416
d: 0.00002722131517763240026 24490.61194568816872 14 0.5799412024501009744 6236649 11491943 0.5533939910881996631 0.5920679387196907205
e: 0.25 2.666666666666666667 1 0.4150374992788437385 3332855 633741 0.1318825170499970352 0.03582028978327999687
anisotropic f32 1
a: 0.01209999993 0.009399999864 0.003299999982 58.4297538 75.21276887 214.2424306 5 6 7 0.5873634367 1599687 4285277 0.1893702038 0.07398074758
b: 0.3000000119 0.3000000119 0.8000000119 2.35666663 2.35666663 0.8837500083 1 1 -1 0.4478319688 11531053 8078907 0.5951566515 0.6685959891
c: 3.5 2.5 4.099999905 0.2020000049 0.2828000069 0.1724390326 -3 -2 -3 0.4531967596 2151017 16545119 0.5170331608 0.5311504353
d: 9.999999747e-6 0.00001999999949 0.00002499999937 70700.0035 35350.00175 28280.0014 16 15 14 0.3858764649 7879831 9249555 0.501178226 0.5019185149
e: 0.25 0.200000003 0.05000000075 2.828000069 3.535000033 14.14000013 1 1 3 0.6930836519 13038603 3730713 0.3926430155 0.3451024397
anisotropic f64 1.5
a: 0.01209999999999999964 0.009400000000000000369 0.003299999999999999982 38.95316804407713403 50.141843971631201 142.8282828282828213 5 5 7 0.384525374722492894 10029133 5991655 0.5052459394404994795 0.5085234049058224828
b: 0.2999999999999999889 0.2999999999999999889 0.8000000000000000444 1.571111111111111084 1.571111111111111084 0.5891666666666666021 0 0 -1 0.5116538625953228122 10248799 16139233 0.7905162756718884721 0.9121854332151380506
c: 3.5 2.5 4.099999999999999645 0.1346666666666666594 0.1885333333333333231 0.1149593495934959387 -3 -3 -4 0.5188511232025329174 12540525 11788171 0.724206285599117372 0.8476591078031504108
d: 0.00001000000000000000082 0.00002000000000000000164 0.0000250000000000000012 47133.33333333332693 23566.66666666666347 18853.33333333333141 15 14 14 0.4243035033538480048 284441 15320695 0.3972277790020887091 0.3229825240857488428
e: 0.25 0.2000000000000000111 0.05000000000000000278 1.885333333333333231 2.356666666666666409 9.426666666666665634 0 1 3 0.4736026959780036416 11199863 15588995 0.7914643137576178808 0.91278263673102894
linear f32 1
c: 4.839421375 0.2066362781 4 0.8394212723 2744371 345023 0.1406125278 0.1406125277
f: 2.222611126 0.449921248 2 0.2226111889 2171753 8077333 0.4030874261 0.4030874372
linear f64 1.5
c: 4.839421453025144106 0.1377575136073197996 4 0.8394214530251442596 865049 10638195 0.1451019396813585448 0.1451019396813585383
f: 2.222611077089287067 0.2999475137772316756 2 0.2226110770892870683 5343855 3731515 0.2438092079182947345 0.2438092079182947181
single f32 1
a: 0.01212394319 82.48141506 0 0.0 14412267 14412267 0.8590380549 0.8590380549
b: 0.8544003899 1.170411442 0 0.0 6334503 6334503 0.3775658011 0.3775658011
c: 4.839421375 0.2066362781 0 0.0 13583869 13583869 0.8096616864 0.8096616864
d: 0.0000272213145 36735.91861 0 0.0 1276535 1276535 0.07608741522 0.07608741522
e: 0.25 4.0 0 0.0 8314221 8314221 0.4955661893 0.4955661893
single f64 1.5
a: 0.01212394325291899374 54.98761028151118462 0 0.0 8648705 8648705 0.5155029892921447754 0.5155029892921447754
b: 0.8544003745317531545 0.7802743146408703366 0 0.0 14690297 14690297 0.8756099343299865723 0.8756099343299865723
c: 4.839421453025144106 0.1377575136073197996 0 0.0 7502201 7502201 0.4471660256385803223 0.4471660256385803223
d: 0.00002722131517763240026 24490.61194568816872 0 0.0 9715751 9715751 0.5791038870811462402 0.5791038870811462402
e: 0.25 2.666666666666666667 0 0.0 8174089 8174089 0.4872136712074279785 0.4872136712074279785
";

/// The thresholds of rows a to e by the same program: `f32` operation by operation, sine and logarithm by mpmath and
/// rounded once.
const LISTINGS: [(&str, [f32; 5]); 2] = [
    ("isotropic", [0.21174225, 0.39938346, 0.6088355, 0.18137224, 0.41333008]),
    ("anisotropic", [0.50508404, 0.055537313, 0.49718252, 0.3928979, 0.45371175]),
];

/// The robust thresholds of rows a to e by a program of the same kind, written from the description of the robust
/// threshold: octaves, cells and hashes exact, the fraction rounded once, the join by mpmath with 200 bits.
const ROBUST: &str = "\
isotropic interpolate f32: 0.2869325477255364504 0.1492595237873893302 0.5600157457179574698 0.9675929427479041196 0.03777390718460083008
isotropic interpolate f64: 0.2869325488676829546 0.1492595214998501486 0.5600157771429263335 0.9675929427229084065 0.03777390718460083008
isotropic copula f32: 0.3113343481307083757 0.1761401997074746991 0.5610263662713281856 0.953135815290514603 0.03777390718460083008
isotropic copula f64: 0.3113343526509751794 0.1761401990122416082 0.5610263944130515375 0.9531358153711679849 0.03777390718460083008
isotropic dithered f32: 0.2743133902549743652 0.2048367857933044434 0.4726642966270446777 0.9455654025077819824 0.03777390718460083008
isotropic dithered f64: 0.2743133902549743652 0.2048367857933044434 0.4726642966270446777 0.9455654025077819824 0.03777390718460083008
anisotropic interpolate f32: 0.2459147574929635555 0.6685960561491117543 0.8343778337295368243 0.285345495442084788 0.05636112635998203498
anisotropic interpolate f64: 0.2459147638700029069 0.6685960512843812082 0.8343777915754651311 0.2853454772118286213 0.05636112203517836001
anisotropic copula f32: 0.1213612594950894798 0.9509933424156478203 0.06702591475546907165 0.781884184740906641 0.3515771542544925806
anisotropic copula f64: 0.1213612636011859282 0.950993331552944899 0.06702585995224684674 0.7818841422095544654 0.3515771576146063626
anisotropic dithered f32: 0.5939288735389709473 0.9619732499122619629 0.01202160120010375977 0.842605292797088623 0.475702822208404541
anisotropic dithered f64: 0.5939288735389709473 0.9619732499122619629 0.01202160120010375977 0.842605292797088623 0.475702822208404541
";

/// The three columns of axes that do not move are zero, where Listing 2 divides by zero.
const FLAT: &str = "0.3,0.4,0.5,0.1,0,0,0,0.1,0";

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hashed-alpha"));
    command.args(arguments).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Runs the program to its end on a text.
fn run(arguments: &[&str], input: impl AsRef<[u8]>) -> Output {
    let mut file = tempfile::tempfile().unwrap();
    file.write_all(input.as_ref()).unwrap();
    file.rewind().unwrap();
    command(arguments).stdin(file).output().unwrap()
}

/// Runs the program where it must succeed; returns its results.
fn succeed(arguments: &[&str], input: impl AsRef<[u8]>) -> String {
    let output = run(arguments, input);
    assert!(output.status.success(), "{arguments:?}: {output:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// Asserts that the program ends with exit code 2, these results and one message that starts in this way.
fn assert_fails(output: &Output, results: &str, message: &str) {
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert_eq!(String::from_utf8_lossy(&output.stdout), results);
    assert!(stderr.starts_with(&format!("error: {message}")), "{stderr}");
}

fn row(letter: &str) -> &'static str {
    ROWS.iter().find(|(name, _)| *name == letter).unwrap().1
}

/// Returns the distance from `value` to the next larger magnitude in a precision.
fn ulp(value: f64, precision: &str) -> f64 {
    let magnitude = value.abs();
    match precision {
        "f32" => f64::from(f32::from_bits((magnitude as f32).to_bits() + 1)) - f64::from(magnitude as f32),
        _ => f64::from_bits(magnitude.to_bits() + 1) - magnitude,
    }
}

/// Reads a printed number in the precision in which it was printed.
fn number(text: &str, precision: &str) -> f64 {
    if precision == "f32" { f64::from(text.parse::<f32>().unwrap()) } else { text.parse().unwrap() }
}

/// The weight is allowed 4 ULP of the logarithm whose fraction it is: that is where it is rounded.
#[test]
fn cdf_and_two_scale_stages_are_within_4_ulp_and_integer_hashes_exact_in_every_bit() {
    let (mut variant, mut precision, mut hash_scale) = ("", "", "");
    for line in STAGES.lines() {
        let Some((letter, expected)) = line.split_once(": ") else {
            let mut words = line.split(' ');
            [variant, precision, hash_scale] = [(); 3].map(|()| words.next().unwrap());
            continue;
        };
        let options = ["--variant", variant, "--precision", precision, "--hash-scale", hash_scale];
        let arguments = [&["eval", "--literal", "--trace", "--hash", "mm4"][..], &options].concat();
        let results = succeed(&arguments, row(letter));
        let (names, values) = results.trim_end().split_once('\n').unwrap();
        let expected: Vec<&str> = expected.split(' ').collect();
        let (names, values): (Vec<_>, Vec<_>) = (names.split(',').collect(), values.split(',').collect());
        assert_eq!((names.len(), values.len()), (expected.len(), expected.len()), "{results}");
        let mut largest_octave = 0.0_f64;
        for ((name, value), expected) in names.into_iter().zip(values).zip(expected) {
            let place = format!("{variant} {precision}, row {letter}, {name}: {value}, not {expected}");
            if name.starts_with("octave") {
                assert_eq!(value, expected, "{place}");
                largest_octave = largest_octave.max(value.parse::<f64>().unwrap().abs());
            } else if name.starts_with("hash") {
                let units: f64 = expected.parse().unwrap();
                assert_eq!(number(value, precision) * 16_777_216.0, units, "{place}");
            } else {
                let wanted: f64 = expected.parse().unwrap();
                let scale = if name == "lerp_factor" { largest_octave + 1.0 } else { wanted };
                let distance = (number(value, precision) - wanted).abs();
                assert!(distance <= 4.0 * ulp(scale, precision), "{place}");
            }
        }
    }
}

#[test]
fn literal_listings_with_the_papers_hash_are_exact_in_every_bit() {
    let rows: Vec<&str> = ["a", "b", "c", "d", "e"].map(row).to_vec();
    for (variant, expected) in LISTINGS {
        let results = succeed(&["eval", "--literal", "--variant", variant], rows.join("\n"));
        let found: Vec<f32> = results.lines().skip(1).map(|line| line.parse().unwrap()).collect();
        assert_eq!(found, expected, "{variant}");
    }
}

#[test]
fn robust_thresholds_agree_with_a_separate_program_for_every_join() {
    let rows: Vec<&str> = ["a", "b", "c", "d", "e"].map(row).to_vec();
    for line in ROBUST.lines() {
        let (options, expected) = line.split_once(": ").unwrap();
        let [variant, join, precision] = options.split(' ').collect::<Vec<_>>()[..] else {
            panic!("{options}")
        };
        let arguments =
            ["eval", "--hash", "mm4", "--variant", variant, "--join", join, "--precision", precision];
        let results = succeed(&arguments, rows.join("\n"));
        assert_eq!(results.lines().count(), 6, "{results}");
        for (found, expected) in results.lines().skip(1).zip(expected.split(' ')) {
            let (found, expected) = (number(found, precision), expected.parse::<f64>().unwrap());
            let distance = (found - expected).abs();
            // The weight is rounded in numbers near 1/4 and enters with a slope of up to 2.
            let tolerance = 4.0 * ulp(expected.max(0.25), precision);
            assert!(distance <= tolerance, "{options}: {found}, not {expected}");
        }
    }
}

#[test]
fn a_repair_that_is_left_out_brings_its_defect_back() {
    let flat = &["eval", "--variant", "anisotropic", "--join", "interpolate"][..];
    assert!(!succeed(flat, FLAT).contains("NaN"));
    assert!(succeed(&[flat, &["--without", "derivative-floor"]].concat(), FLAT).contains("NaN"));
    let output = run(&["eval", "--literal", "--join", "copula"], row("a"));
    assert_fails(&output, "", "--join and --without change the robust threshold");
}

#[test]
fn precision_decides_how_the_input_is_read() {
    // 16777217 is no f32, and the single variant at scale 1 finds the cell of the rounded place.
    let arguments = |precision| ["eval", "--variant", "single", "--hash", "mm4", "--precision", precision];
    let (odd, even) = ("16777217,0,0,1,0,0,0,1,0", "16777216,0,0,1,0,0,0,1,0");
    assert_eq!(succeed(&arguments("f32"), odd), succeed(&arguments("f32"), even));
    assert_ne!(succeed(&arguments("f64"), odd), succeed(&arguments("f64"), even));
}

#[test]
fn a_threshold_does_not_depend_on_where_and_how_its_row_is_written() {
    let expected = succeed(&["eval"], row("a"));
    assert_eq!(expected.lines().next(), Some("threshold"));
    let text =
        format!("# one\r\npx,py,pz,dxx,dxy,dxz,dyx,dyy,dyz\r\n\r\n {}\r\n", row("a").replace(',', " , "));
    assert_eq!(succeed(&["eval"], &text), expected);
    assert_eq!(succeed(&["eval", "-"], &text), expected);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows.csv");
    std::fs::write(&path, text).unwrap();
    assert_eq!(succeed(&["eval", path.to_str().unwrap()], ""), expected);
}

#[test]
fn trace_names_its_columns() {
    let rest = "lerp_factor,hash_coarse,hash_fine,interpolated,threshold\n";
    for variant in ["isotropic", "linear", "single"] {
        let results = succeed(&["eval", "--trace", "--variant", variant], "");
        assert_eq!(results, format!("max_derivative,pixel_scale,octave,{rest}"));
    }
    let axes = ["max_derivative", "pixel_scale", "octave"].map(|name| format!("{name}_x,{name}_y,{name}_z"));
    let results = succeed(&["eval", "--trace", "--variant", "anisotropic"], "");
    assert_eq!(
        results,
        format!("{},lerp_factor_x,lerp_factor_y,lerp_factor_z,{}", axes.join(","), &rest[12..])
    );
    let results = succeed(&["eval", "--trace", "--variant", "anisotropic", "--literal"], "");
    assert_eq!(results, format!("{},{rest}", axes.join(",")));
}

#[test]
fn an_undefined_threshold_is_printed_and_no_error() {
    assert_eq!(succeed(&["eval", "--variant", "anisotropic", "--literal"], FLAT), "threshold\nNaN\n");
    let trace = succeed(&["eval", "--variant", "anisotropic", "--literal", "--trace"], FLAT);
    assert!(trace.contains(",inf,") && trace.ends_with(",NaN\n"), "{trace}");
}

#[test]
fn an_empty_input_gives_a_header_and_a_note() {
    let output = run(&["eval"], "");
    assert!(output.status.success());
    assert_eq!(output.stdout, b"threshold\n");
    assert_eq!(output.stderr, b"note: standard input holds no footprints\n");
}

#[test]
fn a_bad_row_is_named_and_the_rows_before_it_are_kept() {
    let good = row("a");
    let kept = succeed(&["eval"], good);
    for (bad, message) in [
        (good.replacen("0.0003", "o.0003", 1), "column 5 (dxy): `o.0003` is not a number"),
        (good.replacen("2.43", "NaN", 1), "column 3 (pz): `NaN` is not finite in f32"),
        (good.replacen("2.43", "-inf", 1), "column 3 (pz): `-inf` is not finite in f32"),
        (good.replacen("2.43", "1e39", 1), "column 3 (pz): `1e39` is not finite in f32"),
    ] {
        let output = run(&["eval"], format!("{good}\n{bad}\n{good}\n"));
        assert_fails(&output, &kept, &format!("standard input, line 2, {message}"));
    }
    let output = run(&["eval"], format!("{good}\n0.1,0.2\n"));
    assert_fails(&output, &kept, "standard input, line 2: 9 fields are needed, not 2; write px,py,pz,");
    let output = run(&["eval"], [good.as_bytes(), b"\n0,\xfe,0,0,0,0,0,0,0\n"].concat());
    assert_fails(&output, &kept, "standard input, line 2, column 2 (py): `\u{fffd}` is not UTF-8 text");
    let output = run(&["eval"], format!("{good}\n{}", "1".repeat(2 << 20)));
    assert_fails(&output, &kept, "standard input, line 2: longer than 1048576 bytes");
}

#[test]
fn another_header_is_answered_with_the_right_one() {
    let output = run(&["eval"], "x,y,z,dxx,dxy,dxz,dyx,dyy,dyz\n");
    let message =
        "standard input, line 1, column 1 (px): `x` is no name of the header; it reads px,py,pz,dxx,";
    assert_fails(&output, "threshold\n", message);
}

#[test]
fn files_that_cannot_be_read_are_named() {
    assert_fails(&run(&["eval", "no such file"], ""), "", "cannot open no such file: ");
    let folder = tempfile::tempdir().unwrap();
    let output = run(&["eval", folder.path().to_str().unwrap()], "");
    assert_eq!(output.status.code(), Some(2), "{output:?}");
}

#[test]
fn arguments_without_meaning_are_refused() {
    for scale in ["0", "-1", "nan", "inf", "1e-50"] {
        let output = run(&["eval", "--hash-scale", scale], row("a"));
        assert_eq!(output.status.code(), Some(2), "{scale}");
        assert!(output.stdout.is_empty());
    }
    assert!(run(&["eval", "--hash-scale", "1e-50", "--precision", "f64"], row("a")).status.success());
    let output = run(&["eval", "--hash", "mm3"], "");
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("mm4") && message.contains("xxhash32"), "{message}");
    for arguments in [&["no-such-verb"][..], &[]] {
        assert_eq!(run(arguments, "").status.code(), Some(2));
    }
}

#[test]
fn a_reader_that_leaves_is_no_failure() {
    for arguments in [&["scenes", "fence"][..], &["eval", "-"]] {
        let mut child = command(arguments).stdin(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        if let Some(mut stdin) = child.stdin.take() {
            // The program may be gone before it has read all of this.
            let _ = stdin.write_all(format!("{}\n", row("a")).repeat(10_000).as_bytes());
        }
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{output:?}");
        assert!(output.stderr.is_empty(), "{output:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    for arguments in [&["eval"][..], &["scenes"], &["scenes", "wall"], &["--help"], &["--version"]] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = command(arguments).stdout(full).output().unwrap();
        assert_fails(&output, "", "cannot write to standard output: No space left on device");
    }
}

#[test]
fn a_threshold_is_out_before_the_next_row_is_in() {
    let mut child = command(&["eval"]).stdin(Stdio::piped()).spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    writeln!(stdin, "{}", row("a")).unwrap();
    assert_eq!(lines.next().unwrap().unwrap(), "threshold");
    let first = lines.next().unwrap().unwrap();
    writeln!(stdin, "{}", row("a")).unwrap();
    assert_eq!(lines.next().unwrap().unwrap(), first);
    drop(stdin);
    assert!(lines.next().is_none());
    assert!(child.wait().unwrap().success());
}

#[test]
fn every_scene_of_the_list_can_be_evaluated() {
    let list = succeed(&["scenes"], "");
    assert!(list.lines().count() >= 3, "{list}");
    for line in list.lines().filter(|line| line.contains("  rows  ")) {
        let name = line.split(' ').next().unwrap();
        for options in [&[][..], &["--quads"], &["--precision", "f64"], &["--quads", "--precision", "f64"]] {
            let arguments = [&["scenes", name, "--resolution", "24x18"][..], options].concat();
            let rows = succeed(&arguments, "");
            let thresholds = succeed(&["eval"], &rows);
            assert_eq!(rows.lines().count(), thresholds.lines().count(), "{arguments:?}");
            assert!(rows.lines().count() > 1, "{arguments:?}");
            assert!(!thresholds.contains("NaN"), "{arguments:?}");
        }
    }
}

#[test]
fn a_scene_that_does_not_exist_is_answered_with_those_that_do() {
    let output = run(&["scenes", "fenc"], "");
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("'fence'") && message.contains("wall"), "{message}");
    assert_eq!(run(&["scenes", "wall", "--resolution", "0x9"], "").status.code(), Some(2));
}

#[test]
fn a_finding_is_a_rejection_until_it_is_known() {
    let folder = tempfile::tempdir().unwrap();
    let report = folder.path().join("a/report");
    let output = run(
        &["check", "paper:isotropic", "--seed", "7", "--budget", "quick", "--out", report.to_str().unwrap()],
        "",
    );
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let remarks = String::from_utf8(output.stderr).unwrap();
    assert!(remarks.contains("note: seed 7, "), "{remarks}");
    assert!(
        remarks.contains("unexpected: uniform.constant_z of paper:isotropic in f32 is rejected"),
        "{remarks}"
    );
    assert!(String::from_utf8(output.stdout).unwrap().contains("uniform.constant_z"));
    assert!(report.join("index.html").is_file());

    let entry = |check: &str, subject: &str, precision: &str| {
        format!(
            "[[finding]]\ncheck = '{check}'\nsubject = '{subject}'\nprecision = '{precision}'\nreason = 'why'\n"
        )
    };
    let list = folder.path().join("known.toml");
    let constant_z = "uniform.constant_z";
    let stale = entry(constant_z, "paper:isotropic", "f64");
    let unmatched = entry(constant_z, "nobody", "f32");
    std::fs::write(&list, [stale, unmatched].concat()).unwrap();
    let options = [
        "--seed",
        "7",
        "--budget",
        "quick",
        "--json",
        "--no-report",
        "--suite",
        "paper",
        "--expect",
        list.to_str().unwrap(),
    ];
    let output = run(&[&["check", "paper:isotropic"][..], &options].concat(), "");
    let remarks = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{remarks}");
    for remark in [
        "stale: uniform.constant_z of paper:isotropic in f64 is not rejected",
        "note: known findings that name nothing which was tried: ",
    ] {
        assert!(remarks.contains(remark), "{remarks}");
    }
    let lines = String::from_utf8(output.stdout).unwrap();
    let known_lines = lines.lines().filter(|line| !line.contains("\"known\":null"));
    assert!(known_lines.clone().count() > 5, "{lines}");
    assert!(known_lines.clone().all(|line| line.contains("\"verdict\":\"rejected\"")), "{lines}");
    assert!(lines.lines().count() > 2, "{lines}");
    assert!(lines.lines().all(|line| line.starts_with('{') && line.contains("\"seed\":7")), "{lines}");
}

/// The rows in a finding, each with the threshold in front of it: "0.25 at 1,0,0,0.01,0,0,0,0.01,0 and 0.5 at ...".
fn rows_in(finding: &str) -> Vec<(String, String)> {
    let words: Vec<&str> = finding.split([' ', ';']).collect();
    let is_row = |word: &str| word.matches(',').count() == 8;
    let rows = words.windows(3).filter(|words| words[1] == "at" && is_row(words[2]));
    rows.map(|words| (words[0].to_owned(), words[2].to_owned())).collect()
}

#[test]
fn a_row_of_a_finding_is_a_row_of_eval() {
    let claims = ["range", "planes", "continuity", "coverage.mean_aligned", "layers.parallel"];
    let only = claims.iter().flat_map(|claim| ["--only", claim]).collect::<Vec<_>>();
    let options = ["check", "paper", "--budget", "quick", "--json", "--no-report"];
    let output = run(&[&options[..], &only].concat(), "");
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let mut told = std::collections::BTreeSet::new();
    for line in String::from_utf8(output.stdout).unwrap().lines() {
        let line: serde_json::Value = serde_json::from_str(line).unwrap();
        let text = |key: &str| line[key].as_str().unwrap_or_default().to_owned();
        let (check, subject) = (text("check"), text("subject"));
        let variant = subject.strip_prefix("paper:").unwrap();
        for (threshold, row) in rows_in(&text("finding")) {
            let options = ["eval", "--literal", "--variant", variant, "--precision", &text("precision")];
            assert_eq!(
                succeed(&options, &row),
                format!("threshold\n{threshold}\n"),
                "{check} {subject} {row}"
            );
            assert!(row.len() < 60, "{check}: {row}");
            told.insert(check.clone());
        }
    }
    assert!(told.len() >= 8, "{told:?}");
}

#[test]
fn a_hash_grows_until_it_fails_and_a_run_goes_on_where_it_ended() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("hashes.wgsl");
    // The last step of MurmurHash3 over a sum, of which the upper 16 bits are kept.
    let text = "
fn finished(k: u32) -> u32 {
    var h = k;
    h ^= h >> 16u;
    h *= 0x85ebca6bu;
    h ^= h >> 13u;
    h *= 0xc2b2ae35u;
    return h ^ (h >> 16u);
}
fn summed(v: vec4u) -> u32 {
    return finished(v.x * 0x9e3779b1u + v.y * 0x85ebca77u + v.z * 0xc2b2ae3du + v.w * 0x27d4eb2fu) & 0xffff0000u;
}
fn threshold() -> f32 { return 0.5; }";
    std::fs::write(&file, text).unwrap();
    let file = format!("{}#summed", file.display());
    let out = folder.path().join("out").display().to_string();
    let grown = |doublings: &str, more: &[&str]| {
        let base = ["check", &file, "--until-failure", "--budget", "quick", "--doublings", doublings];
        let claims = [
            "--only",
            "hash.values",
            "--only",
            "hash.differences",
            "--only",
            "cells.origin",
            "--only",
            "range",
        ];
        run(&[&base[..], &claims[..], &["--out", &out], more].concat(), "")
    };
    let first = grown("1", &[]);
    let text = String::from_utf8_lossy(&first.stdout);
    assert_eq!(first.status.code(), Some(1), "{text}{}", String::from_utf8_lossy(&first.stderr));
    let line = |claim: &str| text.lines().find(|line| line.contains(claim)).unwrap_or_default().to_owned();
    assert!(line("hash.values").starts_with("fails "), "{text}");
    assert!(
        line("hash.differences").starts_with("holds ") && line("hash.differences").contains(">= 17.0"),
        "{text}"
    );
    assert!(!text.contains("range") && text.contains("3 say nothing about their subject"), "{text}");
    assert!(
        std::fs::read_to_string(folder.path().join("out/growth.svg")).unwrap().contains("hash.differences")
    );
    // The same command has nothing to do, one that goes further begins where it ended.
    let again = grown("1", &["--json"]);
    assert!(String::from_utf8_lossy(&again.stderr).contains("goes on from the "));
    let json = String::from_utf8_lossy(&again.stdout).into_owned();
    assert!(json.lines().count() == 6 && json.contains("\"end\":\"as_far_as_asked\""), "{json}");
    let further = grown("2", &[]);
    assert!(String::from_utf8_lossy(&further.stdout).contains(">= 18.0"));
    let refused = |output: &Output, words: &str| {
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && told.contains(words), "{words}: {told}");
    };
    refused(&grown("2", &["--seed", "1"]), "it is of another seed: 0, and not 1; remove it");
    refused(&run(&["check", "hash:mm5", "--no-report"], ""), "mm4");
    refused(&run(&["check", "--hours", "1"], ""), "--until-failure");
    refused(&run(&["check", "--until-failure", "--hours=-1"], ""), "--hours");
}

#[test]
fn check_finds_mistakes_before_it_starts() {
    assert_fails(
        &run(&["check", "papers"], ""),
        "",
        "unknown subject `papers`. Did you mean `paper`? Known are paper:isotropic, ",
    );
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("known.toml");
    let list = list.to_str().unwrap();
    assert_fails(&run(&["check", "--expect", list], ""), "", &format!("cannot read {list}: "));
    std::fs::write(list, "[[finding]]\nchek = 1\n").unwrap();
    let output = run(&["check", "--expect", list], "");
    assert_fails(&output, "", &format!("{list}: TOML parse error at line 2, column 1"));
    let output = run(&["check", "--out", &format!("{list}/report")], "");
    assert_fails(&output, "", &format!("cannot create {list}/report: "));
}

#[test]
fn a_shader_file_is_put_on_trial() {
    let folder = tempfile::tempdir().unwrap();
    let check = |text: &str| {
        let file = folder.path().join("mine.wgsl");
        std::fs::write(&file, text).unwrap();
        let options = ["--on", "cpu", "--only", "range", "--budget", "quick", "--no-report"];
        run(&[&["check", file.to_str().unwrap()][..], &options].concat(), "")
    };
    let good = check("fn threshold(position: vec3<f32>) -> f32 { return 0.5 + 0.0 * min(position.x, 0.0); }");
    assert!(String::from_utf8(good.stdout).unwrap().contains("mine.wgsl"));
    let not_a_number =
        check("fn threshold(position: vec3<f32>) -> f32 { return sqrt(-1.0 - abs(position.x)); }");
    assert_eq!(not_a_number.status.code(), Some(1));
    for (name, message) in [("a.metal", "MSL is not read"), ("b.usf#f", "b.usf: No such file")] {
        let output = run(&["check", name], "");
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(message), "{error}");
    }
    for (text, message) in [
        ("fn threshold(position: vec3<f32>) -> f32 {\n  return foo(position);\n}", "mine.wgsl:2:10: "),
        (
            "fn threshold(q: vec3<f32>, r: vec3<f32>) -> f32 { return q.x + r.x; }",
            "mine.wgsl:1:1: parameter `q` ",
        ),
        ("fn threshold() -> f32 {\n  loop {}\n  return 1.0;\n}", "mine.wgsl"),
        ("", "the file is empty"),
    ] {
        let output = check(text);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn each_file_has_its_function_and_its_values() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let file = folder.path().join(name);
        std::fs::write(&file, text).unwrap();
        file.to_str().unwrap().to_owned()
    };
    let first = file(
        "first.glsl",
        "uniform vec3 k;\nfloat a(vec3 position) { return k.y + 0.0 * min(position.x, 0.0); }",
    );
    let second =
        file("second.wgsl", "fn b(lod: f32) -> f32 { return 0.5; }\nfn c(lod: f32) -> f32 { return 2.0; }");
    let options = ["--on", "cpu", "--only", "range.far_from_origin", "--budget", "quick", "--no-report"];
    let check = |more: &[&str]| {
        let output = run(&[&["check"][..], more, &options].concat(), "");
        let [out, error] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
        (output.status.code(), out, error)
    };
    let files = [&*format!("{first}#a"), &format!("{second}#b"), &format!("{second}#c")];
    let value = format!("{first}#k=0,0.5,0");
    let (code, out, error) = check(&[&files[..], &["--set", &value]].concat());
    assert_eq!(code, Some(1), "{error}");
    let verdict = |subject: &str| {
        out.lines().find(|line| line.contains(subject)).map(|line| line.starts_with("consistent"))
    };
    let verdicts = ["first.glsl#a", "second.wgsl#b", "second.wgsl#c"].map(verdict);
    assert_eq!(verdicts, [Some(true), Some(true), Some(false)], "{out}");
    for (more, message) in [
        (
            vec![files[0], "--set", "k=1,2"],
            "first.glsl:1:14: `k` is vec3<f32> and takes 3 values, --set k=X,Y,Z, not 2",
        ),
        (
            vec![files[0], "--set", "k=1,2,3", "--set", "k=1,2,4"],
            "--set k=1,2,4: k has a value already, 1,2,3",
        ),
        (vec![files[1], "--set", &value], "first.glsl is none of the files of this run"),
        (
            vec![&*format!("{second}#d")],
            "there is no function `d`. Did you mean `b`? --function NAME takes one of another name; functions are b, c",
        ),
    ] {
        let (code, _, error) = check(&more);
        assert!(code == Some(2) && error.contains(message), "{error}, not {message}");
    }
    let negative = String::from_utf8(run(&["check", "--seed", "-1"], "").stderr).unwrap();
    assert!(
        negative.contains("'-1' for '--seed <N>': a seed is a whole number from 0 to 18446744073709551615"),
        "{negative}"
    );
}

#[test]
fn a_panic_of_the_reader_is_one_message() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("damaged.spv");
    let file = file.to_str().unwrap();
    succeed(&["shader", "--lang", "spirv", "--out", file], "");
    let whole = std::fs::read(file).unwrap();
    let damaged = |word: usize| {
        let mut bytes = whole.clone();
        bytes[4 * word..][..4].copy_from_slice(&1_u32.to_le_bytes());
        bytes
    };
    let panics = |bytes: &Vec<u8>| {
        let read = own::parse("damaged.spv", own::Language::SpirV, bytes, &own::Options::default());
        read.is_err_and(|error| error.message.contains("gave up"))
    };
    let bytes = (5..whole.len() / 4).map(damaged).find(panics).expect("a word that naga panics on");
    std::fs::write(file, bytes).unwrap();
    let message = String::from_utf8(run(&["check", file, "--on", "cpu", "--no-report"], "").stderr).unwrap();
    assert!(message.starts_with("error: ") && message.lines().count() == 1, "{message}");
}

#[test]
fn what_a_language_leaves_open_is_noted() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.wgsl");
    let text = "fn threshold(position: vec3<f32>, frame: u32) -> f32 {
  var table = array<f32, 2>(0.5, 0.25);
  let quotient = 3u / frame;
  return table[2u + quotient];
}";
    std::fs::write(&file, text).unwrap();
    let options = ["--on", "cpu", "--only", "range.far_from_origin", "--budget", "quick", "--no-report"];
    let output = run(&[&["check", file.to_str().unwrap()][..], &options].concat(), "");
    let remarks = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{remarks}");
    for remark in [
        "mine.wgsl:3:18: an integer is divided by zero; x / 0 was x, x % 0 was 0 (",
        "mine.wgsl:4:10: an index is out of range; the last element was taken (",
    ] {
        let line = remarks.lines().find(|line| line.contains(remark)).unwrap_or_else(|| panic!("{remarks}"));
        assert!(line.starts_with("note: mine.wgsl: ") && line.ends_with(" times)"), "{line}");
    }
}

/// Claims about frames hold for a shader that takes all strata in turn, and for no other.
#[test]
fn a_shader_is_held_to_its_frames() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frames.wgsl");
    let spread = "
fn spread(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, frame: u32) -> f32 {
    let x = threshold(position, dpdx, dpdy) + f32(STRATUM) / 8.0;
    return select(x, x - 1.0, x > 1.0);
}";
    let library = succeed(&["shader"], "");
    let check = |stratum: &str, frames: &str| {
        std::fs::write(&file, library.clone() + &spread.replace("STRATUM", stratum)).unwrap();
        let typed = format!("{}#spread", file.display());
        let options = [
            "--on",
            "cpu",
            "--nested-phase",
            "--join",
            "inherit",
            "--only",
            "frames",
            "--budget",
            "quick",
            "--no-report",
        ];
        let output = run(&[&["check", &typed, "--frames", frames][..], &options].concat(), "");
        let results = String::from_utf8(output.stdout).unwrap();
        let rejected: Vec<_> = results
            .lines()
            .filter_map(|line| line.strip_prefix("rejected"))
            .filter_map(|line| line.split_whitespace().next().map(str::to_owned))
            .collect();
        (output.status.code(), rejected)
    };
    let alternating = "((frame % 8u) / 2u + (frame % 2u) * 4u)";
    assert_eq!(check(alternating, "8"), (Some(0), vec![]));
    assert_eq!(check("0u", "1"), (Some(0), vec![]));
    let (code, rejected) = check("0u * frame", "8");
    assert_eq!((code, rejected.contains(&"frames.stratified".to_owned())), (Some(1), true), "{rejected:?}");
    let (code, rejected) = check(alternating, "1");
    assert_eq!((code, rejected.contains(&"frames.static".to_owned())), (Some(1), true), "{rejected:?}");
    // A sequence: steps of the golden ratio in whole numbers, and steps of a tenth.
    let steps = |step: &str| format!("8.0 * f32((frame * {step}u) >> 8u) / 16777216.0");
    let [golden, tenths] = ["2654435769", "429496730"].map(|step| check(&steps(step)[..], "sequence"));
    assert_eq!(golden, (Some(0), vec![]));
    assert_eq!(tenths, (Some(1), vec!["frames.sequence".to_owned()]));
    let (code, rejected) = check("0u", "sequence");
    assert_eq!((code, rejected.contains(&"frames.sequence".to_owned())), (Some(1), true), "{rejected:?}");
}

/// The same results by every set of instructions that this machine has; a name that is none is told.
#[test]
fn instructions_are_chosen_by_the_environment_and_change_no_bit() {
    use hashed_alpha::threshold::batch::Isa;
    let on = |isa: &str| {
        let options = ["check", "robust", "--only", "uniform", "--budget", "quick", "--json", "--no-report"];
        command(&options).env("HASHED_ALPHA_ISA", isa).output().unwrap()
    };
    let outputs: Vec<Vec<u8>> = Isa::available().map(|isa| on(isa.name()).stdout).collect();
    assert!(outputs[0].len() > 1000 && outputs.iter().all(|output| *output == outputs[0]));
    assert_fails(&on("sse9"), "", "HASHED_ALPHA_ISA is \"sse9\"; this machine has ");
}

/// No driver is found where these point.
const NO_DRIVERS: [(&str, &str); 3] = [
    ("VK_DRIVER_FILES", "/nonexistent"),
    ("VK_ADD_DRIVER_FILES", ""),
    ("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"),
];

const SOUND: &str = "fn threshold(position: vec3<f32>) -> f32 { return 0.5 + 0.0 * min(position.x, 0.0); }";

#[test]
fn without_a_driver_the_interpreter_steps_in_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.wgsl");
    std::fs::write(&file, SOUND).unwrap();
    let options = ["--only", "range.far_from_origin", "--budget", "quick", "--no-report"];
    let subjects = ["check", "robust:isotropic", file.to_str().unwrap(), "gpu:robust:isotropic"];
    let output = command(&[&subjects[..], &options].concat()).envs(NO_DRIVERS).output().unwrap();
    let (results, remarks) =
        (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    for remark in [
        "note: robust:isotropic runs on the CPU, in Rust",
        "note: mine.wgsl runs in the interpreter: no GPU: looked for any adapter",
        "unexpected: range.far_from_origin of gpu:robust:isotropic in f32 is unavailable",
    ] {
        assert!(remarks.contains(remark), "{remarks}");
    }
    assert!(!remarks.contains("XDG_RUNTIME_DIR"), "{remarks}");
    assert!(results.contains("consistent") && results.contains("no GPU: looked for"), "{results}");
    assert_eq!(output.status.code(), Some(3), "{remarks}");
}

/// With a driver, too, nobody but this program writes to stderr.
#[test]
fn drivers_are_silent() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.wgsl");
    std::fs::write(&file, SOUND).unwrap();
    let options = ["--only", "range.far_from_origin", "--budget", "quick", "--no-report"];
    let output = command(&[&["check", file.to_str().unwrap()][..], &options].concat())
        .env_remove("XDG_RUNTIME_DIR")
        .env_remove("NODEVICE_SELECT")
        .output()
        .unwrap();
    let remarks = String::from_utf8(output.stderr).unwrap();
    assert!(remarks.lines().all(|line| line.starts_with("note: ")), "{remarks}");
}

#[test]
fn a_loop_that_ends_for_some_fragments_only_is_named_once() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.wgsl");
    let text = "fn threshold(position: vec3<f32>) -> f32 {
  var i = 0u;
  while position.x > 3.0 { i += 1u; }
  return 0.5;
}";
    std::fs::write(&file, text).unwrap();
    let options = ["--on", "cpu", "--only", "range", "--budget", "quick", "--no-report"];
    let output = run(&[&["check", file.to_str().unwrap()][..], &options].concat(), "");
    let results = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(3), "{results}");
    assert!(results.contains("mine.wgsl:3:3: a loop does not end"), "{results}");
}

#[test]
fn claims_stand_beside_device_models_in_one_table() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/shaders/robust_integer.wgsl");
    let options =
        ["--on", "device-model", "--only", "range.far_from_origin", "--budget", "quick", "--no-report"];
    let output = run(&[&["check", file, "--nested-phase"][..], &options].concat(), "");
    let results = String::from_utf8(output.stdout).unwrap();
    let heading = "robust_integer.wgsl    accurate  coarse sine  reduced sine  half     flush to zero  fused";
    let table = results.split_once(heading).unwrap_or_else(|| panic!("{results}")).1;
    assert!(table.starts_with("\nrange.far_from_origin  holds     holds "), "{results}");
}

#[test]
fn a_threshold_is_printed_in_every_language() {
    for (language, word) in
        [("wgsl", "vec3<f32>"), ("glsl", "vec3 "), ("hlsl", "float3 "), ("msl", "metal::float3 ")]
    {
        let text = succeed(&["shader", "--lang", language], "");
        assert!(text.contains("threshold") && text.contains(word), "{text}");
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("threshold.spv");
    succeed(&["shader", "--lang", "spirv", "--out", file.to_str().unwrap()], "");
    assert_eq!(std::fs::read(file).unwrap()[..4], 0x0723_0203_u32.to_le_bytes());
    assert_eq!(run(&["shader", "--literal", "--join", "copula"], "").status.code(), Some(2));
    let ablation = succeed(&["shader", "--variant", "linear"], "");
    assert!(ablation.contains("linear scales (section 5.4.2), stable form, hash sine"), "{ablation}");
    let refused = run(&["shader", "--variant", "single", "--join", "copula"], "");
    assert_fails(&refused, "", "--join changes the robust threshold; single is written as the paper has it");
}

#[cfg(target_os = "linux")]
#[test]
fn what_is_no_file_is_written_through() {
    let text = succeed(&["shader"], "");
    assert_eq!(succeed(&["shader", "--out", "/dev/stdout"], ""), text);
    assert_eq!(succeed(&["shader", "--out", "/proc/self/fd/1"], ""), text);
    let full = run(&["shader", "--out", "/dev/full"], "");
    assert_fails(&full, "", "cannot write /dev/full: No space left on device");
}

#[test]
fn a_shader_file_may_tell_its_size_of_noise_and_its_phase() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.wgsl");
    let file = file.to_str().unwrap();
    succeed(&["shader", "--join", "interpolate", "--hash-scale", "0.25", "--out", file], "");
    let options =
        ["--on", "cpu", "--only", "exact", "--only", "noise_scale", "--budget", "quick", "--no-report"];
    let check = |more: &[&str]| run(&[&["check", file], &options[..], more].concat(), "");
    let output = check(&["--nested-phase", "--hash-scale", "0.25"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    let output = check(&["--nested-phase"]);
    assert_eq!(output.status.code(), Some(1));
    // The first lines say all of it, where nothing is stated.
    assert!(check(&[]).status.success());
    let output = check(&["--hash-scale", "0.25"]);
    let said = String::from_utf8(output.stdout).unwrap().split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("that is sound where it is declared: say --nested-phase"), "{said}");
    assert_eq!(check(&["--hash-scale", "0"]).status.code(), Some(2));
}

/// By their indices alone cells of several octaves would meet, and whole layers have one threshold.
#[test]
fn a_join_that_needs_the_octave_is_refused_without_it() {
    for more in [&["--hash", "pcg3d"][..], &["--without", "octave-word"]] {
        let output = run(&[&["eval", "--join", "inherit"][..], more].concat(), "");
        assert_fails(&output, "", "--join inherit");
    }
    let output = run(&["shader", "--join", "inherit", "--hash", "hoskins"], "");
    assert_fails(&output, "", "--join inherit");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    let robust = "robust = { join = \"inherit\", hash = \"pcg3d\" }";
    let scene = succeed(&["scenes", "noise-scales"], "").replacen("hashed = { hash_scale = 1.0 }", robust, 1);
    std::fs::write(&file, &scene).unwrap();
    let output = run(&["explain", file.to_str().unwrap()], "");
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(String::from_utf8_lossy(&output.stderr).contains("reads the octave"), "{output:?}");
    std::fs::write(&file, scene.replace("pcg3d", "pcg4d")).unwrap();
    succeed(&["explain", file.to_str().unwrap()], "");
}

#[test]
fn help_tells_exit_codes_and_examples() {
    let help = succeed(&["--help"], "");
    assert!(help.contains("Exit codes:") && help.contains("Examples:"), "{help}");
    for verb in ["check", "compare", "eval", "explain", "render", "scenes", "shader"] {
        assert!(succeed(&[verb, "--help"], "").contains("Examples:"), "{verb}");
    }
    assert_eq!(succeed(&["--version"], ""), format!("hashed-alpha {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn a_scene_of_the_gallery_is_a_file_to_start_from() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    let scene = succeed(&["scenes", "noise-scales"], "");
    std::fs::write(&file, &scene).unwrap();
    let small = ["--resolution", "45x35", "--frames", "2"];
    let explained = succeed(&[&["explain", file.to_str().unwrap(), "--shader"][..], &small].concat(), "");
    for word in
        ["runs     hash: isotropic listing", "costs    2 frames", "fn threshold(", "skipped  supersampling"]
    {
        assert!(explained.contains(word), "{word}: {explained}");
    }
    let out = folder.path().join("pictures");
    let render = |file: &std::path::Path| {
        let paths = ["render", file.to_str().unwrap(), "--out", out.to_str().unwrap(), "--sequence"];
        run(&[&paths[..], &small].concat(), "")
    };
    assert!(render(&file).status.code().is_some_and(|code| code < 2));
    let names = ["noise-scales.png", "noise-scales.json", "noise-scales.csv", "noise-scales-1-pixel.png"];
    let files = || names.map(|name| std::fs::read(out.join(name)).unwrap());
    let first = files();
    render(&file);
    assert_eq!(files(), first, "two runs differ");
    // A sentence that does not hold, and a mistake in the file.
    let bound = "[[expect]]\ntake = '1 pixel'\nmetric = 'coverage'\nat_most = ";
    for (more, code) in [(format!("{bound}0.01"), 1), ("[effect]".to_owned(), 2)] {
        std::fs::write(&file, format!("{scene}\n{more}\n")).unwrap();
        assert_eq!(render(&file).status.code(), Some(code), "{more}");
    }
    assert_eq!(run(&["explain", "no-such-scene"], "").status.code(), Some(2));
}

#[test]
fn cost_measures_every_tier_and_draws_the_fronts() {
    const KEYS: [&str; 15] = [
        "name",
        "variant",
        "hash",
        "join",
        "precision",
        "tier",
        "isa",
        "threads",
        "ns_min",
        "ns_median",
        "ratio",
        "bits_equal",
        "error",
        "ks",
        "flips",
    ];
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let lines = succeed(&["cost", "--quick", "--json", "--out", out], "");
    for line in lines.lines() {
        // A key follows a brace or a comma, and no value holds `":`.
        let keys: Vec<_> =
            line.split("\":").filter_map(|part| part.rsplit_once('"')).map(|part| part.1).collect();
        assert_eq!(keys, KEYS, "{line}");
    }
    for tier in ["wgsl-minimum", "fast", "two-ulp", "std", "bit-exact", "f64", "double-double"] {
        assert!(lines.contains(&format!("\"tier\":\"{tier}\"")), "{tier}");
    }
    let table = std::fs::read_to_string(folder.path().join("cost.csv")).unwrap();
    assert_eq!(table.lines().count(), lines.lines().count() + 1);
    for picture in ["sine", "reproducible", "real", "uniform", "stable"] {
        let svg = std::fs::read_to_string(folder.path().join(format!("cost-{picture}.svg"))).unwrap();
        assert!(svg.contains("grey: beaten"), "{picture}");
    }
}

#[test]
fn cost_lists_effects_and_sizes() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let effects = succeed(&["cost", "--effects", "--quick", "--out", out], "");
    assert!(effects.contains("hashed, fade-in") && effects.contains("1.41 to 4.53"), "{effects}");
    assert!(effects.contains("hashed-occlusion") && effects.contains("whole frames"), "{effects}");
    let sizes = succeed(&["cost", "--sizes", "--samples", "20000", "--quick", "--out", out], "");
    assert_eq!(sizes.lines().count(), 3, "{sizes}");
    assert!(folder.path().join("cost-sizes.svg").exists() && folder.path().join("cost-effects.csv").exists());
}

#[test]
fn cost_writes_the_time_of_a_frame_into_a_page() {
    let folder = tempfile::tempdir().unwrap();
    let (out, page) = (folder.path().to_str().unwrap(), folder.path().join("page.md"));
    let marks = ["before\n<!-- cost --drawing -->\n", "<!-- end of cost --drawing -->\nafter\n"];
    std::fs::write(&page, marks.concat()).unwrap();
    let typed = ["cost", "--drawing", "--quick", "--out", out, "--page", page.to_str().unwrap()];
    let table = succeed(&typed, "");
    let written = std::fs::read_to_string(&page).unwrap();
    assert!(written.starts_with(marks[0]) && written.ends_with(marks[1]), "{written}");
    // Four takes at five sizes below the headings, and below a rule in the page.
    assert_eq!([table.lines().count(), written.lines().count()], [21, 26], "{table}{written}");
    assert!(folder.path().join("cost-drawing.csv").exists());
}

#[test]
fn the_recommended_threshold_is_a_subject_in_two_presets() {
    let check = |subject: &str| {
        succeed(&["check", subject, "--only", "range.degenerate", "--budget", "quick", "--no-report"], "")
    };
    let both = check("recommended");
    assert!(both.contains("recommended:steady") && both.contains("recommended:smooth"), "{both}");
    let steady = check("recommended:steady");
    assert!(!steady.contains("recommended:smooth"), "{steady}");
    let output = run(&["check", "recommended:stedy"], "");
    assert_fails(&output, "", "unknown subject `recommended:stedy`. Did you mean `recommended:steady`?");
}

#[test]
fn a_hash_that_cannot_tell_octaves_apart_is_joined_as_in_the_paper() {
    let output = run(&["eval", "--hash", "pcg3d"], row("a"));
    assert!(String::from_utf8(output.stderr).unwrap().contains("joined by interpolate, as in the paper"));
    let stated = succeed(&["eval", "--hash", "pcg3d", "--join", "interpolate"], row("a"));
    assert_eq!(String::from_utf8(output.stdout).unwrap(), stated);
}

#[test]
fn hashes_are_listed_and_measured() {
    let list = succeed(&["hashes"], "");
    assert_eq!(list.lines().count(), 25, "{list}");
    let one = succeed(&["hashes", "lowbias-linear"], "");
    assert!(one.contains("1774"), "{one}");
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let measure = ["hashes", "weyl", "--measure", "--doublings", "0", "--quick", "--out", out];
    let table = succeed(&measure, "");
    assert!(table.contains("weyl") && table.lines().count() == 2, "{table}");
    let lines = std::fs::read_to_string(folder.path().join("hashes.jsonl")).unwrap();
    assert!(lines.starts_with("{\"hash\":\"weyl\",\"doublings\":0,"), "{lines}");
    assert!(folder.path().join("hashes.svg").is_file());
    let refused = run(&["hashes", "--measure", "--page", "no-such-page.md", "--out", out], "");
    assert_fails(&refused, "", "cannot read no-such-page.md");
}
