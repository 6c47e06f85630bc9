#include <cstdint>
extern "C" const char* orb_call(const char*) { return ""; }
