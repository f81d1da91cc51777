fn rotated_left(word: u32, places: u32) -> u32 {
    return (word << places) | (word >> (32u - places));
}
