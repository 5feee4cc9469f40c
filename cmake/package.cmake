# A Debian package of the program and one of the library: `make package`, or cpack in the build folder.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME angioscope)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
set(CPACK_PACKAGE_VENDOR "The Angioscope developers")
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR})
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(ANG_MAINTAINER "The Angioscope developers <angioscope@packages.invalid>" CACHE STRING "Who answers for the Debian packages")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${ANG_MAINTAINER})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME angioscope)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# Opened or started only where they are there: OpenGL, the font of annotations, the plots of reports.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "fonts-dejavu-core, libegl1, libgl1-mesa-dri, libosmesa6")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "gnuplot-nox")
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION
    "viewer for CT and CT-angiography volumes
Opens DICOM folders, NIfTI files and raw volumes and shows them as linked
slices and as a volume rendering, with presets for what a radiologist wants
to see. It also makes pictures without a display and without a GPU, and says
how wrong a picture may be.
.
Angioscope is not a medical device and not for diagnosis.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libangioscope-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
if(ANG_WITH_OPENCV)
    set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libopencv-core-dev, libopencv-imgproc-dev, libstdc++-12-dev | libstdc++-dev")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
    "volume rendering of CT and CT angiography as a library
The library of the viewer Angioscope, for programs in C: volumes, transfer
functions, scenes, renderers with and without OpenGL, and how wrong their
pictures may be. It neither reads files nor opens windows.
.
Its interface may still change from version to version.")

# What Debian's policy wants beside a package's files: its licence and what has changed, under the package's own name.
file(READ ${CMAKE_SOURCE_DIR}/LICENSE licence)
string(REGEX REPLACE "^MIT License\n\nCopyright \\(c\\) ([^\n]*)\n\n" "" licence "${licence}")
set(holders ${CMAKE_MATCH_1})
string(REGEX REPLACE "\n+$" "" licence "${licence}")
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " licence "${licence}")
configure_file(cmake/debian/copyright.in ${CMAKE_BINARY_DIR}/debian/copyright @ONLY)
foreach(component IN ITEMS RUNTIME DEVELOPMENT)
    set(package ${CPACK_DEBIAN_${component}_PACKAGE_NAME})
    configure_file(cmake/debian/changelog.in ${CMAKE_BINARY_DIR}/debian/${package}/changelog @ONLY)
    execute_process(COMMAND gzip -9nf ${CMAKE_BINARY_DIR}/debian/${package}/changelog COMMAND_ERROR_IS_FATAL ANY)
    string(TOLOWER ${component} lower)
    install(FILES ${CMAKE_BINARY_DIR}/debian/${package}/changelog.gz RENAME changelog.Debian.gz
            DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${lower} EXCLUDE_FROM_ALL)
    install(FILES ${CMAKE_BINARY_DIR}/debian/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
            COMPONENT ${lower} EXCLUDE_FROM_ALL)
endforeach()
install(FILES ${CMAKE_BINARY_DIR}/manual/angioscope.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
        RENAME _angioscope COMPONENT runtime EXCLUDE_FROM_ALL)
include(CPack)
