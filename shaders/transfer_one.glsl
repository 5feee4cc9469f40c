// An entry of the table where all that shows has one colour: extinction alone is looked up.
uniform samplerBuffer transfer_extinction;
uniform vec3 transfer_colour;

vec4 transfer_entry(int i) {
    return vec4(transfer_colour, texelFetch(transfer_extinction, i).r);
}
