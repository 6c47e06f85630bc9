#pragma once

#include "base/refuse.h"

#include <exception>
#include <string>
#include <system_error>
#include <type_traits>

namespace orb {

/// Does a step that gives a tl::expected with a Failure. What it throws comes back as one: a bug of
/// orb, exit 70, or a system without descriptors or threads, exit 3. So whoever drives a robot
/// stops it before that is said. What is no std::exception passes.
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
