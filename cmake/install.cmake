# What `cmake --install` installs, in two components: "runtime", the program with all that it needs, and "development",
# the core library for other programs. Nothing installed holds the prefix: all of it may be moved together.
include(GNUInstallDirs)

install(TARGETS angioscope RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/presets DESTINATION ${CMAKE_INSTALL_DATADIR}/angioscope COMPONENT runtime)
# A component of its own, "plain": what Debian's packages have elsewhere (package.cmake).
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT plain)
install(FILES ${CMAKE_BINARY_DIR}/manual/angioscope.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions
        RENAME _angioscope COMPONENT plain)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime FILES_MATCHING PATTERN "*.md")

# Manual pages are kept compressed; -n, so that the same page gives the same file.
set(manual_page ${CMAKE_BINARY_DIR}/manual/angioscope.1.gz)
add_custom_command(
    OUTPUT ${manual_page}
    COMMAND gzip -9nc ${CMAKE_BINARY_DIR}/manual/angioscope.man > ${manual_page}
    DEPENDS ${CMAKE_BINARY_DIR}/manual/angioscope.man
    VERBATIM)
add_custom_target(manual_page ALL DEPENDS ${manual_page})
add_dependencies(manual_page manual)
install(FILES ${manual_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime)
function(install_completion shell folder name)
    install(FILES ${CMAKE_BINARY_DIR}/manual/angioscope.${shell} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder}
            RENAME ${name} COMPONENT runtime)
endfunction()
install_completion(bash bash-completion/completions angioscope)
install_completion(fish fish/vendor_completions.d angioscope.fish)
if(ANG_WINDOW)
    install(FILES cmake/desktop/angioscope.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT runtime)
    install(FILES cmake/desktop/angioscope.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps
            COMPONENT runtime)
endif()

# The core library: one static archive with what it is made of. Static, since its interface is not yet kept stable: a
# program goes on with the version that it was built with.
set(library_parts ang_core ang_glad ang_shaders)
foreach(part IN ITEMS ang_cast_avx2 ang_cast_avx512)
    if(TARGET ${part})
        list(APPEND library_parts ${part})
    endif()
endforeach()
list(TRANSFORM library_parts REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE library_objects)
add_library(angioscope_library STATIC ${library_objects})
set_target_properties(angioscope_library PROPERTIES OUTPUT_NAME angioscope LINKER_LANGUAGE C)
install(TARGETS angioscope_library ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
# Without what only a debugger reads: most of its size, and the paths of this machine.
install(CODE "execute_process(COMMAND \"${CMAKE_STRIP}\" --strip-debug --enable-deterministic-archives
    \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/libangioscope.a\" COMMAND_ERROR_IS_FATAL ANY)"
        COMPONENT development)

# What others may include; the rest is how it is done.
file(GLOB library_headers CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}
     core/base/*.h core/math/*.h core/volume/*.h core/transfer/*.h core/scene/*.h core/plan/*.h core/error/*.h)
list(FILTER library_headers EXCLUDE REGEX "simd|phantom_parts|opencv")
list(APPEND library_headers core/cpu/reference.h core/proxy/proxy.h core/proxy/slicer.h core/render/calibrate.h core/render/context.h core/render/method.h
     core/render/planner.h core/render/progressive.h core/selfcheck/selfcheck.h)
foreach(header IN LISTS library_headers)
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/angioscope/${folder} COMPONENT development)
endforeach()

set(library_needs "-lm -ldl -pthread")
if(ANG_WITH_OPENCV)
    set(library_needs "-lopencv_imgproc -lopencv_core -lstdc++ ${library_needs}")
endif()
file(RELATIVE_PATH prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" prefix_from_pc ${prefix_from_pc})
configure_file(cmake/angioscope.pc.in ${CMAKE_BINARY_DIR}/angioscope.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/angioscope.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
install(FILES docs/example.c DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT development)
