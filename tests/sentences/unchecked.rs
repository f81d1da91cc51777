//! Sentences that nothing here can measure, and what it would take.

/// Source and place, the sentence, and what is missing.
pub const SENTENCES: &[(&str, &str, &str)] = &[
    (
        "TVCG Table 1",
        "Times of ten scenes on a GeForce GTX 1080.",
        "that card, and the ten scenes with their textures",
    ),
    (
        "TVCG §11",
        "The stochastic prototype is slow because its seed texture needs synchronisation.",
        "the prototype, or a GPU renderer with such a texture",
    ),
    (
        "TVCG §11, Table 1",
        "A frame with stochastic alpha testing takes 1.4 to 4.5 times that with the traditional test.",
        "a GPU renderer with a texture of seeds; for frames in software, whose generator is in a register, docs/cost.md has the ratios",
    ),
    (
        "TVCG §11",
        "The anisotropic variant costs perhaps 10 to 20 % more than the isotropic one.",
        "a GPU of 2016; the price list measures the ratio on processors",
    ),
    ("TVCG Figs. 1, 11", "The beard of a game's head model vanishes with distance.", "the head model"),
    (
        "TVCG Fig. 9, I3D Fig. 6",
        "The alpha maps of the trees are 50 to 75 % transparent (I3D: 50 to 70 %).",
        "the XFrog models; the two versions disagree",
    ),
    ("TVCG Fig. 16", "San Miguel shows subtle differences only.", "the model and its textures"),
    (
        "TVCG §1",
        "Today's games widely alpha test foliage, fences, decals and small details.",
        "a survey of games",
    ),
    (
        "TVCG §3",
        "Fetching alpha from a finer level thrashes the texture cache.",
        "counters of a GPU's texture cache",
    ),
    ("TVCG §7.1", "Values of n around 6 work well.", "viewers: it is a matter of taste and of the texture"),
    ("TVCG §7.1", "Noise seems to depend on solid angle.", "viewers"),
    (
        "TVCG §7.2.1",
        "Eight samples make the smaller noise scale no compelling solution.",
        "viewers; the figures are in `temporal.noise_scale`",
    ),
    (
        "TVCG §7.2.3",
        "The alternating order was sufficiently stable.",
        "viewers; the figures are in `temporal.sufficient`",
    ),
    (
        "TVCG §6.1",
        "Axes of discretisation that follow the anisotropy would be unstable.",
        "an implementation of that rejected idea, which the paper does not give",
    ),
    (
        "TVCG §11",
        "Foveated rendering needs temporal antialiasing for hashed alpha to be of use.",
        "a head-mounted display with eye tracking",
    ),
    (
        "GDC 2017, Results",
        "0.06, 0.08 and 1.3 ms for the test, the hash and the ground truth at 1024 x 1024.",
        "the scene and the card",
    ),
    ("GDC 2017, Results", "Thresholds of an artist for each level need manual work.", "artists"),
    (
        "Humus 2009",
        "1.09 ms against 1.99 ms; 10 instructions against one.",
        "a Radeon HD 3870 X2 and the shader",
    ),
    ("Humus 2009", "The technique was used in a game of 2011.", "its source code"),
    (
        "Ols 2009",
        "Titles that use stippled alpha; two of them turned out to use alpha-to-coverage.",
        "their source code",
    ),
    (
        "Ols 2009",
        "Performance is that of a slightly modified alpha test.",
        "the renderer; the operations are two fractions and two comparisons",
    ),
    (
        "Ols 2009",
        "It is the only viable option for translucency in deferred rendering.",
        "a comparison of renderers of 2009",
    ),
];
