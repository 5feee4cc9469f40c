// Pixels that are finished never run the shader, even where it discards.
layout(early_fragment_tests) in;
