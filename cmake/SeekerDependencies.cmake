# Debian 12 packages. Every one is a SYSTEM include, so that our warnings speak of our code only.
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(tl-expected REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(spdlog REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Protobuf REQUIRED)
find_package(OpenSSL 3 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(SQLite3 REQUIRED)

# libboost1.81-dev: the default 1.74 does not compile coroutines with this compiler (docs/architecture.md).
find_package(Boost 1.81 REQUIRED)

pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
# With FreeType, which loads the font.
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo-ft freetype2)
find_package(prometheus-cpp REQUIRED)
pkg_check_modules(SYSTEMD REQUIRED IMPORTED_TARGET libsystemd)
# fuzzylite.pc has an empty version: ask for none.
pkg_check_modules(FUZZYLITE REQUIRED IMPORTED_TARGET fuzzylite)

# Header-only.
find_package(nanoflann REQUIRED)
find_package(nlohmann_json REQUIRED)

# Debian's OpenCVConfig.cmake belongs to libopencv-dev, which brings GUI and contrib; the single -dev packages
# have headers and libraries only.
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
add_library(seeker_opencv INTERFACE)
target_include_directories(seeker_opencv SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
foreach(module calib3d features2d flann imgproc core)
  find_library(OPENCV_${module}_LIBRARY opencv_${module} REQUIRED)
  target_link_libraries(seeker_opencv INTERFACE ${OPENCV_${module}_LIBRARY})
endforeach()

# Cameras alone need this one: it brings the codecs.
find_library(OPENCV_videoio_LIBRARY opencv_videoio REQUIRED)
add_library(seeker_opencv_video INTERFACE)
target_link_libraries(seeker_opencv_video INTERFACE seeker_opencv ${OPENCV_videoio_LIBRARY})

add_library(seeker_asio INTERFACE)
target_include_directories(seeker_asio SYSTEM INTERFACE ${Boost_INCLUDE_DIRS})
target_compile_definitions(seeker_asio INTERFACE BOOST_ASIO_NO_DEPRECATED)
target_link_libraries(seeker_asio INTERFACE Threads::Threads OpenSSL::SSL OpenSSL::Crypto)
