/* The presets that come with the program, by name. */
#ifndef ANG_TESTS_IO_SHIPPED_PRESETS_H
#define ANG_TESTS_IO_SHIPPED_PRESETS_H

static const char *const shipped[] = {"cta-head",
                                      "cta-neck",
                                      "cta-thorax",
                                      "cta-coronaries",
                                      "cta-abdominal-aorta",
                                      "cta-runoff",
                                      "cta-pulmonary-arteries",
                                      "ct-bone",
                                      "ct-skull",
                                      "ct-soft-tissue",
                                      "ct-lung",
                                      "ct-airways",
                                      "ct-skin",
                                      "ct-metal-stent",
                                      "ct-mip",
                                      "ct-xray",
                                      "mra"};

#endif
