//! A user's own images and meshes either work or are refused with a message that names the file and the reason.

use hashed_alpha::render::draw::texture::TextureNeeds;
use hashed_alpha::render::scene_file::load::{Scene, prepare};
use hashed_alpha::render::scene_file::read;
use image::{DynamicImage, GrayImage, RgbImage, RgbaImage};
use std::fs;
use std::path::Path;

fn scene(folder: &Path, texture: &str, surface: &str) -> Result<Scene, String> {
    let text = format!(
        "name = 's'\n[camera]\neye = [0.0, 0.0, 5.0]\ntarget = [0.0, 0.0, 0.0]\n{texture}\n[[surface]]\n{surface}\n"
    );
    let file = read::read(&text, "s.toml").expect("a sound scene file");
    prepare(file, folder).map_err(|error| {
        let mut message = error.to_string();
        let mut cause = std::error::Error::source(&error);
        while let Some(source) = cause {
            message += &format!(": {source}");
            cause = source.source();
        }
        message
    })
}

fn with_image(folder: &Path, name: &str, alpha: &str) -> Result<Scene, String> {
    let texture = format!("[[texture]]\nname = 't'\nimage = {{ file = '{name}', alpha = '{alpha}' }}");
    scene(folder, &texture, "texture = 't'\ncard = { size = [1.0, 1.0] }")
}

#[test]
fn images_of_every_kind_are_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let save = |name: &str, image: DynamicImage| image.save(folder.path().join(name)).expect("written");
    save("large.png", RgbaImage::from_pixel(4096, 4096, image::Rgba([9, 99, 9, 51])).into());
    save(
        "deep.png",
        DynamicImage::ImageRgba16(image::ImageBuffer::from_pixel(8, 4, image::Rgba([0, 0, 0, 13_107]))),
    );
    save("wide.png", RgbaImage::from_pixel(65_535, 1, image::Rgba([0, 0, 0, 51])).into());
    save(
        "grey-alpha.png",
        DynamicImage::ImageLumaA8(image::ImageBuffer::from_pixel(3, 5, image::LumaA([255, 51]))),
    );
    for name in ["large.png", "deep.png", "wide.png", "grey-alpha.png"] {
        let scene = with_image(folder.path(), name, "alpha").unwrap_or_else(|error| panic!("{error}"));
        let texture = &scene.textures(&TextureNeeds::default())[0];
        assert!((texture.levels[0].alphas().mean() - 0.2).abs() < 1e-4, "{name}");
        assert_eq!(texture.levels.last().expect("a level").size, [1, 1]);
    }
    save("grey.png", GrayImage::from_pixel(3, 5, image::Luma([51])).into());
    save("colour.jpg", RgbImage::from_pixel(16, 16, image::Rgb([51, 51, 51])).into());
    for name in ["grey.png", "colour.jpg"] {
        let scene = with_image(folder.path(), name, "luminance").unwrap_or_else(|error| panic!("{error}"));
        assert!(
            (scene.textures(&TextureNeeds::default())[0].levels[0].alphas().mean() - 0.2).abs() < 0.01,
            "{name}"
        );
    }
    let mut palette = Vec::new();
    let mut encoder = png::Encoder::new(&mut palette, 2, 1);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(vec![255, 0, 0, 0, 255, 0]);
    encoder.set_trns(vec![0, 102]);
    encoder.write_header().expect("a header").write_image_data(&[0, 1]).expect("pixels");
    fs::write(folder.path().join("palette.png"), palette).expect("written");
    let scene = with_image(folder.path(), "palette.png", "alpha").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.textures(&TextureNeeds::default())[0].levels[0].alpha, [0.0, 0.4]);
}

#[test]
fn images_that_cannot_be_used_are_refused_with_the_reason() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = |name: &str| folder.path().join(name);
    GrayImage::new(4, 4).save(place("grey.png")).expect("written");
    RgbaImage::new(64, 64).save(place("sound.png")).expect("written");
    let sound = fs::read(place("sound.png")).expect("read");
    fs::write(place("truncated.png"), &sound[..sound.len() / 2]).expect("written");
    fs::write(place("empty.png"), []).expect("written");
    fs::write(place("text.png"), "no image").expect("written");
    // Width and height stand at bytes 16 to 23.
    let mut none = sound.clone();
    none[16..20].fill(0);
    fs::write(place("zero.png"), none).expect("written");
    let mut huge = sound;
    huge[16..24].fill(0x7f);
    fs::write(place("huge.png"), huge).expect("written");
    fs::create_dir(place("folder.png")).expect("made");
    for (name, reason) in [
        ("grey.png", "no alpha channel; write `alpha = \"luminance\"`"),
        ("truncated.png", "cannot read"),
        ("empty.png", "cannot read"),
        ("text.png", "cannot read"),
        ("zero.png", "cannot read"),
        ("huge.png", "cannot read"),
        ("missing.png", "cannot open"),
        ("folder.png", ""),
    ] {
        let message = with_image(folder.path(), name, "alpha").map(|_| ()).expect_err(name);
        assert!(message.contains(name) && message.contains(reason), "{message}");
    }
}

fn levels_of(scene: &Scene) -> Vec<([u32; 2], f64)> {
    let texture = &scene.textures(&TextureNeeds::default())[0];
    texture.levels.iter().map(|level| (level.size, level.alphas().mean())).collect()
}

fn with_table(folder: &Path, image: &str) -> Result<Scene, String> {
    scene(
        folder,
        &format!("[[texture]]\nname = 't'\nimage = {{ {image} }}"),
        "texture = 't'\ncard = { size = [1.0, 1.0] }",
    )
}

#[test]
fn alpha_comes_from_any_channel_or_another_image() {
    let folder = tempfile::tempdir().expect("a folder");
    let save = |name: &str, image: DynamicImage| image.save(folder.path().join(name)).expect("written");
    save("packed.png", RgbImage::from_pixel(4, 4, image::Rgb([51, 102, 204])).into());
    save("colour.jpg", RgbImage::from_pixel(8, 8, image::Rgb([200, 200, 200])).into());
    save("grey.png", GrayImage::from_pixel(4, 4, image::Luma([153])).into());
    save("solid.png", RgbaImage::from_pixel(4, 4, image::Rgba([51, 102, 204, 255])).into());
    save("soft.png", RgbaImage::from_pixel(4, 4, image::Rgba([0, 0, 0, 51])).into());
    save("leaf.tga", RgbaImage::from_pixel(4, 4, image::Rgba([9, 9, 9, 51])).into());
    save("leaf.webp", RgbaImage::from_pixel(4, 4, image::Rgba([9, 9, 9, 51])).into());
    for (table, alpha, note) in [
        ("file = 'packed.png', alpha = 'red'", 0.2, ""),
        ("file = 'packed.png', alpha = 'green'", 0.4, ""),
        ("file = 'packed.png', alpha = 'blue'", 0.8, ""),
        (
            "file = 'packed.png', alpha = 'luminance'",
            0.387,
            "packed.png: its luminance is 0.39 in the mean, its red, green and blue 0.20, 0.40 and 0.80",
        ),
        ("file = 'colour.jpg', alpha_file = 'grey.png'", 0.6, ""),
        ("file = 'colour.jpg', alpha_file = 'soft.png'", 0.2, ""),
        ("file = 'colour.jpg', alpha_file = 'packed.png', alpha = 'red'", 0.2, ""),
        ("file = 'solid.png'", 1.0, "solid.png: its alpha channel is opaque everywhere"),
        ("file = 'leaf.tga'", 0.2, ""),
        ("file = 'leaf.webp'", 0.2, ""),
    ] {
        let scene = with_table(folder.path(), table).unwrap_or_else(|error| panic!("{table}: {error}"));
        let (size, found) = levels_of(&scene)[0];
        assert!(size == [4, 4] && (found - alpha).abs() < 0.002, "{table}: {size:?} {found}");
        assert_eq!(scene.notes.is_empty(), note.is_empty(), "{table}: {:?}", scene.notes);
        assert!(scene.notes.iter().all(|told| told.starts_with(note)), "{table}: {:?}", scene.notes);
    }
    // Colours of the one beside alpha of the other.
    let scene = with_table(folder.path(), "file = 'colour.jpg', alpha_file = 'grey.png'").expect("read");
    let [red, ..] = scene.textures(&TextureNeeds::default())[0].levels[0].colour[0];
    assert!((f32::from(red) / 65_535.0 - 200.0 / 255.0).abs() < 0.01, "{red}");
    let premultiplied = RgbaImage::from_pixel(1, 1, image::Rgba([51, 0, 0, 102]));
    save("premultiplied.png", premultiplied.into());
    let scene = with_table(folder.path(), "file = 'premultiplied.png', premultiplied = true").expect("read");
    assert_eq!(scene.textures(&TextureNeeds::default())[0].levels[0].colour, [[32_768, 0, 0]]);
}

/// A block of 4 x 4 texels of one alpha as BC3: two equal ends, and 16 indices of the first.
fn bc3(alpha: u8) -> Vec<u8> {
    let mut block = vec![alpha, alpha, 0, 0, 0, 0, 0, 0];
    block.extend([0xe0, 0x07, 0xe0, 0x07, 0, 0, 0, 0]);
    block
}

/// A DDS file of `DXT5` blocks, whose levels have the alphas that are given.
fn dds(side: u32, alphas: &[u8]) -> Vec<u8> {
    let mut bytes = b"DDS ".to_vec();
    let words = [124, 0x000a_1007, side, side, 16, 0, alphas.len() as u32];
    bytes.extend(words.into_iter().chain([0; 11]).flat_map(u32::to_le_bytes));
    bytes.extend([32, 4].into_iter().flat_map(u32::to_le_bytes));
    bytes.extend(b"DXT5");
    bytes.extend([0; 20]);
    bytes.extend([0x0040_1008_u32, 0, 0, 0, 0].into_iter().flat_map(u32::to_le_bytes));
    for (level, &alpha) in alphas.iter().enumerate() {
        let blocks = side.checked_shr(level as u32).unwrap_or(0).max(1).div_ceil(4);
        bytes.extend(bc3(alpha).repeat((blocks * blocks) as usize));
    }
    bytes
}

/// A KTX2 file of a Vulkan format, with the bytes of its levels.
fn ktx2(format: u32, side: u32, packed: u32, levels: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    bytes.extend(
        [format, 1, side, side, 0, 0, 1, levels.len() as u32, packed].into_iter().flat_map(u32::to_le_bytes),
    );
    let index = 80 + 24 * levels.len() as u32;
    bytes.extend([index, 4, 0, 0].into_iter().flat_map(u32::to_le_bytes));
    bytes.extend([0_u64; 2].into_iter().flat_map(u64::to_le_bytes));
    let mut from = u64::from(index) + 4;
    for level in levels {
        let length = level.len() as u64;
        bytes.extend([from, length, length].into_iter().flat_map(u64::to_le_bytes));
        from += length;
    }
    bytes.extend(4_u32.to_le_bytes());
    bytes.extend(levels.concat());
    bytes
}

#[test]
fn device_formats_are_read_with_their_own_levels() {
    let folder = tempfile::tempdir().expect("a folder");
    let save = |name: &str, bytes: Vec<u8>| fs::write(folder.path().join(name), bytes).expect("written");
    save("leaf.dds", dds(8, &[51, 102, 255]));
    let plain = |side: usize, alpha: u8| [0, 200, 0, alpha].repeat(side * side);
    save("leaf.ktx2", ktx2(37, 4, 0, &[plain(4, 51), plain(2, 102), plain(1, 255)]));
    save("block.ktx2", ktx2(137, 4, 0, &[bc3(51)]));
    save("grey.ktx2", ktx2(9, 4, 0, &[vec![51; 16]]));
    let read = |table: &str| {
        levels_of(&with_table(folder.path(), table).unwrap_or_else(|error| panic!("{table}: {error}")))
    };
    let close = |found: &[([u32; 2], f64)], wanted: &[(u32, f64)]| {
        let is_close = |(found, wanted): (&([u32; 2], f64), &(u32, f64))| {
            found.0 == [wanted.0; 2] && (found.1 - wanted.1).abs() < 1e-4
        };
        assert!(
            found.len() == wanted.len() && found.iter().zip(wanted).all(is_close),
            "{found:?} {wanted:?}"
        );
    };
    // Levels that no mean of the finest would have.
    close(&read("file = 'leaf.dds'"), &[(8, 0.2), (4, 0.4), (2, 1.0)]);
    close(&read("file = 'leaf.ktx2'"), &[(4, 0.2), (2, 0.4), (1, 1.0)]);
    // More levels than there can be.
    save("many.dds", dds(8, &[51; 40]));
    assert_eq!(read("file = 'many.dds'").len(), 4);
    // One level alone is halved.
    close(&read("file = 'block.ktx2'"), &[(4, 0.2), (2, 0.2), (1, 0.2)]);
    close(&read("file = 'grey.ktx2', alpha = 'luminance'"), &[(4, 0.2), (2, 0.2), (1, 0.2)]);
    let mut short = dds(8, &[51, 102, 255]);
    short.truncate(160);
    save("short.dds", short);
    save("packed.ktx2", ktx2(37, 4, 2, &[plain(4, 51)]));
    save("basis.ktx2", ktx2(0, 4, 1, &[plain(4, 51)]));
    save("astc.ktx2", ktx2(157, 4, 0, &[bc3(51)]));
    save("few.ktx2", ktx2(37, 4, 0, &[plain(2, 51)]));
    save("cut.ktx2", ktx2(37, 4, 0, &[plain(4, 51)])[..60].to_vec());
    // A block of the description of the data whose texel blocks are 256 wide.
    let mut blocks = ktx2(37, 4, 0, &[plain(4, 51)]);
    blocks[52..56].copy_from_slice(&28_u32.to_le_bytes());
    blocks.splice(108..108, [0, 0, 0, 0, 2, 0, 24, 0, 1, 1, 1, 0, 0xff, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0]);
    save("blocks.ktx2", blocks);
    let mut huge = dds(8, &[51]);
    huge[12..20].fill(0x7f);
    save("huge.dds", huge);
    let mut cube = dds(8, &[51]);
    cube[113] = 0xfe;
    save("cube.dds", cube);
    for (name, reason) in [
        ("short.dds", "ends before its level 0"),
        ("packed.ktx2", "packed once more (Zstandard)"),
        ("basis.ktx2", "packed once more (Basis)"),
        ("astc.ktx2", "of a kind that is not read here"),
        ("few.ktx2", "cannot be decoded: expected surface to have at least 64 bytes but found 16"),
        ("cut.ktx2", "is no sound KTX2 file"),
        ("blocks.ktx2", "is no sound KTX2 file"),
        ("huge.dds", "pixels"),
        ("cube.dds", "is a cube map"),
    ] {
        let message = with_table(folder.path(), &format!("file = '{name}'")).map(|_| ()).expect_err(name);
        assert!(message.contains(name) && message.contains(reason), "{name}: {message}");
    }
}

/// A triangle as glTF: its buffer is named by `buffer`, its texture by `image`.
fn gltf(buffer: &str, image: &str, indices: &str) -> String {
    let material = if image.is_empty() {
        String::new()
    } else {
        format!(
            r#""images":[{{"uri":"{image}"}}],"textures":[{{"source":0}}],
               "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}},"alphaMode":"MASK"}}],"#
        )
    };
    let use_material = if image.is_empty() { "" } else { r#","material":0"# };
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"mesh":0,"translation":[1.0,0.0,0.0]}}],{material}
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}}{use_material}{indices}}}]}}],
        "buffers":[{{"byteLength":66{buffer}}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":24}},
                       {{"buffer":0,"byteOffset":60,"byteLength":6}}],
        "accessors":[
          {{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
          {{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}},
          {{"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"}}]}}"#
    )
}

/// Three corners, three texture coordinates, three indices.
fn triangle(indices: [u16; 3]) -> Vec<u8> {
    let floats = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0];
    let bytes = floats.iter().flat_map(|value| value.to_le_bytes());
    bytes.chain(indices.iter().flat_map(|index| index.to_le_bytes())).collect()
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    bytes
        .chunks(3)
        .flat_map(|three| {
            let at = |i: usize| u32::from(three.get(i).copied().unwrap_or(0));
            let word = at(0) << 16 | at(1) << 8 | at(2);
            let letter = move |i: u32| char::from(LETTERS[(word >> (18 - 6 * i) & 63) as usize]);
            let length = three.len();
            (0..4).map(move |i| if i as usize <= length { letter(i) } else { '=' })
        })
        .collect()
}

const INDEXED: &str = r#","indices":2"#;

#[test]
fn meshes_are_read_embedded_external_and_binary() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = |name: &str| folder.path().join(name);
    let data = triangle([0, 1, 2]);
    RgbaImage::from_pixel(2, 2, image::Rgba([0, 0, 0, 102])).save(place("leaf.png")).expect("written");
    RgbImage::from_pixel(2, 2, image::Rgb([0, 0, 0])).save(place("bark.png")).expect("written");
    fs::write(place("data.bin"), &data).expect("written");
    let embedded = format!(r#","uri":"data:application/octet-stream;base64,{}""#, base64(&data));
    let external = r#","uri":"data.bin""#;
    fs::write(place("embedded.gltf"), gltf(&embedded, "leaf.png", INDEXED)).expect("written");
    fs::write(place("external.gltf"), gltf(external, "leaf.png", "")).expect("written");
    fs::write(place("opaque.gltf"), gltf(external, "bark.png", INDEXED)).expect("written");
    fs::write(place("plain.gltf"), gltf(external, "", INDEXED)).expect("written");
    let mut json = gltf("", "leaf.png", INDEXED).into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut padded = data;
    padded.resize(padded.len().next_multiple_of(4), 0);
    let mut glb = b"glTF".to_vec();
    for word in [2, 12 + 8 + json.len() + 8 + padded.len(), json.len(), 0x4e4f_534a] {
        glb.extend((word as u32).to_le_bytes());
    }
    glb.extend(json);
    for word in [padded.len(), 0x004e_4942] {
        glb.extend((word as u32).to_le_bytes());
    }
    glb.extend(padded);
    fs::write(place("binary.glb"), glb).expect("written");
    for (name, alpha) in [
        ("embedded.gltf", 0.4),
        ("external.gltf", 0.4),
        ("binary.glb", 0.4),
        ("opaque.gltf", 1.0),
        ("plain.gltf", 1.0),
    ] {
        let surface = format!("mesh = {{ file = '{name}', scale = 2.0 }}");
        let scene = scene(folder.path(), "", &surface).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scene.mesh.triangles.len(), 1, "{name}");
        // Moved by its node, scaled by the scene.
        assert_eq!(scene.mesh.vertices[1].object, glam::dvec3(4.0, 0.0, 0.0), "{name}");
        assert!(
            (scene.textures(&TextureNeeds::default())[0].levels[0].alphas().mean() - alpha).abs() < 1e-6,
            "{name}"
        );
    }
    // A texture of the scene in place of its own, which may then be missing.
    fs::write(place("untextured.gltf"), gltf(external, "gone.png", INDEXED)).expect("written");
    let texture = "[[texture]]\nname = 't'\nconstant = { alpha = 0.25 }";
    let scene = scene(folder.path(), texture, "texture = 't'\nmesh = { file = 'untextured.gltf' }");
    assert_eq!(
        scene.unwrap_or_else(|error| panic!("{error}")).textures(&TextureNeeds::default())[0].levels[0].alpha
            [0],
        0.25
    );
}

#[test]
fn meshes_that_cannot_be_drawn_are_refused_with_the_reason() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = |name: &str| folder.path().join(name);
    fs::write(place("data.bin"), triangle([0, 1, 2])).expect("written");
    fs::write(place("wild.bin"), triangle([0, 1, 7])).expect("written");
    let buffer = |name: &str| format!(r#","uri":"{name}""#);
    let sound = gltf(&buffer("data.bin"), "", INDEXED);
    fs::write(place("texture.gltf"), gltf(&buffer("data.bin"), "gone.png", INDEXED)).expect("written");
    fs::write(place("buffer.gltf"), gltf(&buffer("gone.bin"), "", INDEXED)).expect("written");
    fs::write(place("wild.gltf"), gltf(&buffer("wild.bin"), "", INDEXED)).expect("written");
    fs::write(place("broken.gltf"), &sound[..sound.len() / 2]).expect("written");
    fs::write(place("nothing.gltf"), r#"{"asset":{"version":"2.0"}}"#).expect("written");
    fs::write(place("text.glb"), "no mesh").expect("written");
    let node = r#""nodes":[{"mesh":0,"#;
    for (name, from, to) in [
        ("itself.gltf", node, r#""nodes":[{"mesh":0,"children":[0],"#),
        ("shared.gltf", node, r#""nodes":[{"children":[1,2]},{"name":"leaf"},{"children":[1]},{"mesh":0,"#),
        ("indices.gltf", r#""componentType":5123,"count":3"#, r#""componentType":5123,"count":4"#),
        ("corners.gltf", r#""count":3,"type":"VEC3""#, r#""count":4000,"type":"VEC3""#),
        ("view.gltf", r#""byteOffset":60"#, r#""byteOffset":66"#),
        ("endless.gltf", r#""count":3,"type":"VEC2""#, r#""count":4294967295,"type":"VEC2""#),
        ("kind.gltf", r#""TEXCOORD_0":1"#, r#""TEXCOORD_0":2"#),
    ] {
        assert!(sound.contains(from), "{name}");
        fs::write(place(name), sound.replace(from, to)).expect("written");
    }
    for (name, reason) in [
        ("texture.gltf", "texture.gltf names image 0, gone.png, which cannot be read"),
        ("buffer.gltf", "buffer.gltf names buffer 0, gone.bin, which cannot be read"),
        ("itself.gltf", "node 0 is reached twice"),
        ("shared.gltf", "node 1 (leaf) is reached twice"),
        ("indices.gltf", "accessor 2 has 4 elements, more than its buffer view holds"),
        ("corners.gltf", "accessor 0 has 4000 elements, more than its buffer view holds"),
        ("view.gltf", "accessor 2 has 3 elements, more than its buffer view holds"),
        ("endless.gltf", "accessor 1 has 4294967295 elements, too many"),
        ("kind.gltf", "accessor 2 is of the wrong type for texture coordinates"),
        ("wild.gltf", "names a vertex that is not there"),
        ("broken.gltf", "cannot read"),
        ("nothing.gltf", "no scene"),
        ("text.glb", "it is no glTF file: neither JSON nor GLB"),
        ("missing.gltf", "cannot read"),
    ] {
        let surface = format!("mesh = {{ file = '{name}' }}");
        let message = scene(folder.path(), "", &surface).map(|_| ()).expect_err(name);
        assert!(message.contains(name) && message.contains(reason), "{message}");
    }
}
