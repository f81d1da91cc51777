//! scratch
use hashed_alpha::shader::gpu::{Choice, Device, Kernel, adapter};
use std::time::{Duration, Instant};
fn main() {
    let t = Instant::now();
    for a in adapter::adapters() { println!("{} {}", a.name(), a.is_software()); }
    println!("{:?}", t.elapsed());
    for name in std::env::args().skip(2) {
        let t = Instant::now();
        let d = Device::open_with_timeout(&Choice::from(name.as_str()), Duration::from_secs(3)).unwrap();
        println!("{name}: open {:?}", t.elapsed());
        let t = Instant::now();
        let p = d.compile(&Kernel::of_words("", 1, 1, "array(bitcast<u32>(log2(number(0u))))")).unwrap();
        println!("compile {:?}", t.elapsed());
        let t = Instant::now();
        let input: Vec<f32> = (0..3_000_000).map(|i| i as f32 * 0.37 + 0.1).collect();
        let out: Vec<f32> = p.map(&input).unwrap();
        println!("map {:?} {:?}", t.elapsed(), &out[..3]);
        let p = d.compile(&Kernel::of_drawn_words("", 1, "array(word(0u))")).unwrap();
        let out = p.draw::<u32>(7, 3_000_000).unwrap();
        println!("{:?} {:?}", out.time, &out.outputs[..3]);
        assert!(out.outputs.iter().enumerate().all(|(i, &w)| w == hashed_alpha::shader::gpu::program::drawn_word(7, i as u32, 0)));
        println!("{:?}", d.compile(&Kernel::of_words("", 1, 1, "array(foo(number(0u)))")).err());
        println!("{:?}", d.compile(&Kernel::of_words("fn f(x: u32) -> u32 { if x > 0u {made_words[0] = 3u; } return 2139806637u; }", 1, 1, "array(f(word(0u)))")).unwrap().map::<u32, u32>(&[0]).err());
        if std::env::args().nth(1).unwrap() == "endless" {
        let t = Instant::now();
        let r = d.compile(&Kernel::of_words("fn f(x: u32) -> u32 { var y = x; loop { y = y * 3u + 1u; if y == 0xffffffffu && x == 17u { break; } } return y; }", 1, 1, "array(f(word(0u)))"));
        println!("{:?} {:?}", r.as_ref().err(), t.elapsed());
        if let Ok(r) = r { println!("{:?} {:?}", r.map::<u32, u32>(&[2; 100]).err(), t.elapsed()); }
        println!("{:?}", p.draw::<u32>(7, 3).err());
        } else {
        println!("{:?}", d.destroy());
        println!("{:?}", p.draw::<u32>(7, 3).err());
        }
    }
    println!("end {:?}", t.elapsed());
}
