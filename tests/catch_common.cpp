// The object that the precompiled headers of all tests are made with (tests/CMakeLists.txt).
