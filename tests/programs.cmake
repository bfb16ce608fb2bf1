# A toolchain file for projects that tests configure: CMake looks for programs along PATH, and not in the system's folders as well
# (programs.sh).
list(APPEND CMAKE_IGNORE_PATH /bin /sbin /usr/bin /usr/sbin /usr/local/bin /usr/local/sbin)
