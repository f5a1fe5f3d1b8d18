# Where results come from: versions, known when the build is configured, and the git commit, looked up at every build.
# Only files whose text changes are written, so that a new commit compiles one small source again.
set(generated ${CMAKE_BINARY_DIR}/generated/io)
configure_file(${CMAKE_SOURCE_DIR}/src/io/build_info.hpp.in ${generated}/build_info.hpp @ONLY)
add_custom_target(freestand_git_commit
  COMMAND ${CMAKE_COMMAND} -D SOURCE=${CMAKE_SOURCE_DIR} -D OUTPUT=${generated}/git_commit.hpp
          -P ${CMAKE_SOURCE_DIR}/src/io/git_commit.cmake
  BYPRODUCTS ${generated}/git_commit.hpp
  COMMENT "Looking up the git commit" VERBATIM)
add_dependencies(freestand_io freestand_git_commit)
target_include_directories(freestand_io PRIVATE ${generated})
