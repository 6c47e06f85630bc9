#include "playground/engine/engine.h"

#include <emscripten.h>
#include <exception>

// The only entry point for a page: a request as JSON in, its answer as JSON out. Exceptions are
// handled only in this file of the playground, so it contains nothing else.

/// The result is valid until the next call.
extern "C" EMSCRIPTEN_KEEPALIVE const char* orb_call(const char* request) {
  using namespace orb;
  static playground::Engine engine;
  static std::string last;
  try { // the JSON library throws if a member has another type
    last = engine.answer(request);
  } catch (const std::exception& exception) {
    last = playground::refusal({ExitCode::Usage, exception.what()});
  }
  return last.c_str();
}
