// An entry of the transfer function's table, colour and extinction.
uniform samplerBuffer transfer_table;

vec4 transfer_entry(int i) {
    return texelFetch(transfer_table, i);
}
