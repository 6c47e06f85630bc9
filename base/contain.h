#pragma once

#include "base/refuse.h"

#include <exception>
#include <string>
#include <system_error>
#include <type_traits>

namespace orb {

/// Runs a step that returns a tl::expected with a Failure, and turns an exception into a Failure:
/// exit 70 for a bug in orb, exit 3 for a system out of descriptors or threads. This lets the
/// caller stop a robot before it reports the error. Exceptions not derived from std::exception pass
/// through.
template <class Step>
std::invoke_result_t<Step> contain(Step&& step) {
  try {
    return step();
  } catch (const std::system_error& error) {
    return refuse(ExitCode::File, error.what());
  } catch (const std::exception& error) {
    return refuse(ExitCode::Bug, std::string("internal error: ") + error.what() +
                                     "; this is a bug in orb: please report it with the command "
                                     "line");
  }
}

} // namespace orb
