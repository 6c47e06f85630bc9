# Emscripten as Debian packages it, 3.1.6 of 2022: its C++ library is LLVM's of version 13, without the
# algorithms of std::ranges, std::from_chars for floating numbers and std::bit_cast.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
