// Where a ray crosses a plane. It depends on pixel and plane alone, so that it is the same bits whichever box draws it
// (numerics.md).
uniform float slice_inverse_reference; // 1 / mm from the eye to the plane of p; in parallel projection 1

// The stretch of a ray that a sample stands for.
struct Slab {
    vec3 place;   // index: the sample
    vec3 before;  // index: the sample before, or where the ray enters the box
    vec3 beyond;  // index: where the ray leaves the box; the sample itself where a plane follows
    float length; // mm: half-way to the neighbouring planes; the first and the last reach to the faces of the box
    bool first;
    bool last;
};

vec3 slice_across(vec2 pixel) {
    precise vec3 across = pixel.x * ray_step_x + pixel.y * ray_step_y;
    return across;
}

vec3 slice_place(int plane, vec3 across) {
    precise float moved = slice_depth(plane) * slice_inverse_reference;
    precise vec3 place = (ray_origin + moved * ray_from_eye) + (1.0 + ray_spread * moved) * across;
    return place;
}

// Half of what a ray moves from plane to plane.
vec3 slice_half_way(vec2 pixel) {
    float moved = 0.5 * slice_distance * slice_inverse_reference;
    return moved * (ray_from_eye + ray_spread * slice_across(pixel));
}

bool slice_in_box(vec3 place) {
    return all(greaterThanEqual(place, box_lower)) && all(lessThanEqual(place, box_upper)) && half_space_has(place);
}

// Along the ray, as long as it is on the plane of p: mm.
vec3 slice_along_mm(vec2 pixel) {
    vec2 spread = ray_spread * pixel;
    return ray_from_eye_mm + spread.x * ray_step_x_mm + spread.y * ray_step_y_mm;
}

// mm of the ray in one mm of depth. The picture's axes and the view axis are at right angles, so that the way across is
// that from the middle of the picture.
uniform vec2 slice_middle;   // pixels; the foot of the eye's perpendicular
uniform float slice_tangent; // of the angle between the axis and the ray one pixel off it; in parallel projection 0

float slice_slant(vec2 pixel) {
    vec2 off = (pixel - slice_middle) * slice_tangent;
    return sqrt(1.0 + dot(off, off));
}
