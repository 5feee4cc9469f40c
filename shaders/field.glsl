// The volume's texture, 16 bits normalised. Places are in voxel index space about the box's centre.
uniform sampler3D field_values;
uniform vec3 field_scale;  // texture coordinate = scale * place + offset
uniform vec3 field_offset;
