# How everything is compiled: one interface target that every target of ours links.
add_library(seeker_flags INTERFACE)
target_include_directories(seeker_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(seeker_flags INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)

# GCC 12 takes members of an empty std::optional for uninitialised (GCC bug 80635), most of all under sanitizers.
target_compile_options(seeker_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)

if(SEEKER_SANITIZE)
  target_compile_options(seeker_flags INTERFACE -fsanitize=${SEEKER_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(seeker_flags INTERFACE -fsanitize=${SEEKER_SANITIZE})
  if(SEEKER_SANITIZE MATCHES "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Asio uses atomic_thread_fence, which GCC warns about under TSan; Asio's own locks make it harmless.
    target_compile_options(seeker_flags INTERFACE -Wno-tsan)
  endif()
  if(SEEKER_SANITIZE MATCHES "undefined")
    target_compile_options(seeker_flags INTERFACE -fno-sanitize-recover=all)
  endif()
endif()

# Asserts of the standard library stay on in debug-like builds.
target_compile_definitions(seeker_flags INTERFACE $<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()
find_program(MOLD_PROGRAM mold)
if(MOLD_PROGRAM)
  target_link_options(seeker_flags INTERFACE -fuse-ld=mold)
endif()
