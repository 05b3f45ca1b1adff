// Compiled for its precompiled header alone (undex.cmake).
