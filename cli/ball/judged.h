#pragma once

#include "base/render.h"
#include "protocol/judge/judge.h"
#include "spec/robots.h"

#include <string>
#include <string_view>
#include <vector>

namespace orb::cli {

/// A judged conversation.
struct Judged {
  std::string robot; ///< its address or another name; may be empty
  spec::Packets packets = spec::Packets::V1;
  protocol::Judgement judgement;
};

/// What the numbers of places count.
enum class Numbered : std::uint8_t { Lines, Frames, Nothing };

/// The verdicts of one file or one served session.
struct JudgedLog {
  std::string name; ///< of the file or of the other source
  Numbered numbered = Numbered::Lines;
  std::vector<Judged> conversations;

  /// True if no client made a mistake.
  bool is_clean() const;
};

/// For people: each mistake, its first place, and what to do instead.
std::string judged_text(const JudgedLog& log, Style style, const Say& say);
/// Schema orb.judge/1 (docs/reference/json.md).
std::string judged_json(const JudgedLog& log, const Say& say);
/// For CI servers: a test for each rule, its mistakes as failures. Notes are left out.
std::string judged_junit(const JudgedLog& log);

} // namespace orb::cli
