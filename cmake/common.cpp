// The object that the precompiled headers of all rooms are made with (cmake/gannet.cmake).
