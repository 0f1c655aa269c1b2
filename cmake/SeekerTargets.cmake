# seeker_library(NAME [DEPS ...]): the library seeker_NAME from all .cpp files of the current folder
# (main*.cpp apart). A folder of headers only becomes an interface library.
function(seeker_library name)
  cmake_parse_arguments(ARG "" "" "DEPS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main[^/]*\\.cpp$")
  set(target seeker_${name})
  if(sources)
    add_library(${target} STATIC ${sources})
    target_link_libraries(${target} PUBLIC seeker_flags ${ARG_DEPS})
    # A section for each function: programs are linked without those that they cannot reach (tests/arch/unreached.sh).
    target_compile_options(${target} PRIVATE -ffunction-sections)
    seeker_unite(${target})
  else()
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE seeker_flags ${ARG_DEPS})
  endif()
endfunction()

# seeker_program(NAME SOURCE [DEPS ...]): an executable over libraries, its main at most 60 lines.
function(seeker_program name source)
  cmake_parse_arguments(ARG "" "" "DEPS" ${ARGN})
  if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${source})
    return()
  endif()
  add_executable(${name} ${source})
  target_link_libraries(${name} PRIVATE seeker_flags ${ARG_DEPS})
  target_link_options(${name} PRIVATE LINKER:--gc-sections)
  target_compile_definitions(${name} PRIVATE SEEKER_VERSION="${PROJECT_VERSION}")
  set_property(GLOBAL APPEND PROPERTY SEEKER_PROGRAMS ${name})
endfunction()

# seeker_test(NAME [DEPS ...] [LABELS ...] [TIMEOUT S] [THREADS]): one test program from all test_*.cpp of the current
# folder. THREADS: what it tests starts threads, so that it is run under ThreadSanitizer too (label `threads`, target
# threaded_tests); tests/arch sees to it that the folders of algorithms start none.
add_custom_target(threaded_tests)
function(seeker_test name)
  cmake_parse_arguments(ARG "THREADS" "TIMEOUT" "DEPS;LABELS" ${ARGN})
  if(NOT SEEKER_TESTS)
    return()
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/test_*.cpp)
  if(NOT sources)
    return()
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(SEEKER_SANITIZE)  # an instrumented test takes up to ten times as long
    math(EXPR ARG_TIMEOUT "10 * ${ARG_TIMEOUT}")
  endif()
  if(ARG_THREADS)
    list(APPEND ARG_LABELS threads)
    add_dependencies(threaded_tests test_${name})
  endif()
  add_executable(test_${name} ${sources})
  target_link_libraries(test_${name} PRIVATE seeker_flags seeker_test_support ${ARG_DEPS} GTest::gmock GTest::gtest_main)
  seeker_unite(test_${name})
  list(JOIN ARG_LABELS "-" label)  # gtest_discover_tests takes one; ctest -L finds parts of it
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS "${label}")
endfunction()

# seeker_fuzz(NAME [DEPS ...]): fuzz_NAME.cpp as a libFuzzer program with SEEKER_FUZZ; otherwise a program that
# replays the corpus tests/fuzz/corpus/NAME, run as a test.
function(seeker_fuzz name)
  cmake_parse_arguments(ARG "" "" "DEPS" ${ARGN})
  set(corpus ${CMAKE_CURRENT_SOURCE_DIR}/corpus/${name})
  if(SEEKER_FUZZ)
    add_executable(fuzz_${name} fuzz_${name}.cpp)
    target_link_libraries(fuzz_${name} PRIVATE seeker_flags ${ARG_DEPS})
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
  elseif(SEEKER_TESTS)
    add_executable(replay_${name} fuzz_${name}.cpp replay_main.cpp)
    target_link_libraries(replay_${name} PRIVATE seeker_flags ${ARG_DEPS})
    add_test(NAME fuzz.replay_${name} COMMAND replay_${name} ${corpus})
  endif()
endfunction()

# seeker_bench(NAME [DEPS ...]): bench_NAME.cpp as a Google Benchmark program.
function(seeker_bench name)
  cmake_parse_arguments(ARG "" "" "DEPS" ${ARGN})
  if(SEEKER_BENCH)
    add_executable(bench_${name} bench_${name}.cpp)
    target_link_libraries(bench_${name} PRIVATE seeker_flags ${ARG_DEPS} benchmark::benchmark)
  endif()
endfunction()
