#pragma once

#include "playground/engine/log_link.h"
#include "playground/engine/request.h"
#include "protocol/decoder.h"
#include "run/line_map.h"
#include "uploader/upload.h"

#include <optional>
#include <string>
#include <vector>

namespace orb::playground {

/// What a page needs to open links to robots and write to them.
Answer links(Request& request);

/// An upload over a link that only answers later. Each step runs uploader::deliver() from the start
/// on a log of the link's operations; where the log ends, deliver() asks for the next one. So the
/// same C++ code decides as for any other link.
class Upload {
public:
  static tl::expected<Upload, Problem> start(Request& request);

  /// Takes the result of the last operation; returns the next one, or how the upload ended.
  std::string step(const ordered_json& done);

private:
  std::string next();

  uploader::Delivery delivery_;
  std::optional<run::LineMap> lines_; ///< of the program that is started
  uploader::BatteryPolicy battery_ = uploader::BatteryPolicy::Refuse;
  uploader::Budgets budgets_;
  std::uint8_t first_seq_ = 0;
  std::vector<Done> log_;
};

/// The packets that start (`what`: "run") what a request uploads, or stop ("stop") everything that
/// runs, and the wheels.
Answer tell_robot(Request& request);

/// Extracts printed text from bytes that arrive in pieces of any size.
class RobotEar {
public:
  /// Returns prints and error messages in the request's `bytes`.
  Answer hear(Request& request);

private:
  protocol::Decoder decoder_{protocol::Direction::FromBall};
};

} // namespace orb::playground
