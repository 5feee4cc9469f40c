// Each sample asks for its block: where blocks are not visible the textures may hold nothing.
const int march_group = 1;
