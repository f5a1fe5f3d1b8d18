# Eigen's decompositions: minutes of processor time and gigabytes, and findings in Eigen's own headers alone.
freestand_not_analyzed(${CMAKE_SOURCE_DIR}/src/measurement/fit/judge.cpp)
