# Two commands do everything: `make demo` and `make test`; `make install` and `make package` pass it on (docs/install.md).
# The build itself is CMake's: see CMakePresets.json.
PACKAGES := build-essential cmake ninja-build pkg-config python3 python3-glad zlib1g-dev libbz2-dev libzip-dev libpng-dev \
	libcjson-dev libcmocka-dev libgdcm-dev libseccomp-dev libnifti-dev libopenimageio-dev libopencv-dev libosmesa6-dev \
	libegl-dev libegl1 libgl1-mesa-dri libglfw3-dev libx11-dev libimgui-dev xvfb xdotool fonts-dejavu-core gnuplot-nox ffmpeg \
	dicom3tools dcm2niix zsh fish man-db clang-format clang libclang-rt-14-dev
DEMO := demo
PREFIX := /usr/local

.PHONY: all packages build demo test install package sanitize fuzz lint format clean

all: build

packages:
	@sh cmake/packages.sh $(PACKAGES)

build: packages
	@cmake --preset default >build.log 2>&1 || { cat build.log; exit 1; }
	@cmake --build --preset default
	@rm -f build.log

demo: build
	@sh cmake/demo.sh build/angioscope $(DEMO)

test: build
	@ctest --test-dir build --output-on-failure --no-tests=error

install: build
	@DESTDIR="$(DESTDIR)" cmake --install build --prefix "$(PREFIX)" --strip >build.log || { cat build.log; exit 1; }
	@rm -f build.log
	@echo "Installed below $(DESTDIR)$(PREFIX)"

package: build
	@cpack --config build/CPackConfig.cmake -B build >build.log 2>&1 || { cat build.log; exit 1; }
	@rm -rf build.log build/_CPack_Packages
	@ls build/*.deb

sanitize: packages
	@cmake --preset sanitize
	@cmake --build --preset sanitize
	@ctest --test-dir build-sanitize --output-on-failure --no-tests=error

# SECONDS of each fuzz target; TARGETS: only these.
SECONDS := 10
fuzz: packages
	@sh tests/fuzz/run.sh . $(SECONDS) $(TARGETS)

lint: build
	@git ls-files 'app/*.c' 'core/*.c' 'io/*.c' 'ui/*.c' 'core/*.cpp' 'io/*.cpp' 'ui/*.cpp' | xargs clang-tidy -p build --quiet

format:
	@git ls-files '*.c' '*.h' '*.cpp' | xargs clang-format -i

clean:
	@rm -rf build build-sanitize build-minimal build-fuzz $(DEMO)
