// The two cells of a footprint and the weight of the second one.
struct TwoScale {
    floor_cell: Cell,
    ceil_cell: Cell,
    lerp_factor: f32,
}
