#include "playground/engine/engine.h"

#include <emscripten.h>
#include <exception>

// The one door between a page and orb: a request as JSON in, its answer as JSON out. Of all files
// of the playground only this one looks after exceptions, so it holds nothing else.

/// What comes back is good until the next call.
extern "C" EMSCRIPTEN_KEEPALIVE const char* orb_call(const char* request) {
  using namespace orb;
  static playground::Engine engine;
  static std::string last;
  try { // the JSON library throws where a member is of another kind
    last = engine.answer(request);
  } catch (const std::exception& exception) {
    last = playground::refusal({ExitCode::Usage, exception.what()});
  }
  return last.c_str();
}
