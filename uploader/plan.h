#pragma once

#include "protocol/macro.h"
#include "protocol/packet.h"
#include "spec/basic.h"
#include "uploader/budgets.h"

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

namespace orb::uploader {

using spec::Area;

/// What an upload must know about the ball's firmware.
struct Capabilities {
  std::size_t ram_bytes = 0; ///< size of the orbBasic RAM area, including the final NUL
  std::size_t flash_bytes = 0;
  bool has_basic = false;
  spec::BasicVersion language{};    ///< of its orbBasic, if it has one
  std::uint8_t macro_executive = 0; ///< version as in spec/macro.def; 0: not reported
  bool can_commit = false;          ///< has Commit RAM Program to Flash (API 1.47)
  /// It has no firmware or does not run it: no other command works.
  bool in_bootloader = false;
};

/// Parses an answer of Get Versioning. A record of 8 bytes predates API 1.46, unless its orbBasic
/// is newer. Source: API §Get Versioning and its history of revisions, M107.
Capabilities read_capabilities(ByteView version_record);

/// Returns the capabilities of the newest firmware, assumed when no ball is asked.
Capabilities default_capabilities();

/// A program to upload: text with its final NUL.
struct ProgramJob {
  Bytes image;
  Area area = Area::Ram;
  std::optional<std::uint16_t> start_line; ///< runs it from this line
};

enum class MacroKind : std::uint8_t { Temporary, User, Stream };

struct MacroJob {
  protocol::MacroImage image;
  MacroKind kind = MacroKind::Temporary;
  bool run = false;          ///< a stream always runs as it arrives
  bool clear_others = false; ///< first erase all user macros
};

/// How a program or macro is transferred.
enum class Route : std::uint8_t {
  Ram,             ///< a program into RAM
  RamThenFlash,    ///< into RAM, then committed: flash changes completely or not at all
  FlashDirectly,   ///< erases and writes flash: a failure loses the old program
  TemporaryPacket, ///< a temporary macro in one packet
  TemporaryChunks, ///< a longer one in chunks
  UserMacro,       ///< a macro under its own id
  StreamedMacro    ///< a macro of any length, played while it arrives
};

/// The role of a step in an upload.
enum class StepKind : std::uint8_t {
  Prepare, ///< harmless to repeat, and changes nothing stored
  Erase,   ///< erases what was stored
  Count,   ///< asks how many packets the ball has received, if it says so
  Append,  ///< sends the content in pieces, each of which must arrive exactly once
  Barrier, ///< after the content: all answers have arrived, and the count fits
  Store,   ///< makes it permanent: commit, save
  Start    ///< runs it
};

struct Step {
  StepKind kind = StepKind::Prepare;
  spec::ApiCommand command{};
  Bytes data{};                    ///< the payload; for Append, the prefix of each piece
  Bytes content{};                 ///< for Append
  std::vector<std::size_t> cuts{}; ///< sizes of the pieces; empty: as large as a packet allows
};

/// The steps after the greeting if nothing fails, and the time by which an upload ends whatever
/// fails.
struct Plan {
  Route route = Route::Ram;
  std::vector<Step> steps;
  int attempts = 1;            ///< most attempts for the steps up to the Barrier
  std::size_t size = 0;        ///< bytes of the program or macro
  std::size_t pieces = 1;      ///< packets for them, if none is shortened
  std::size_t link_pieces = 0; ///< pieces of all packets, on a link that takes pieces
  Duration expected{};         ///< estimated time if nothing fails
  Duration deadline{};         ///< from the first attempt to open the link
  /// What the user should know about the route; may be empty.
  std::string note;
  std::string_view again = "upload again"; ///< remedy after a failure
};

/// Why this ball cannot take an upload at all: a sentence.
struct PlanError {
  std::string message;
};

tl::expected<Plan, PlanError> make_plan(const ProgramJob& job, const Capabilities& ball,
                                        const Budgets& budgets);
tl::expected<Plan, PlanError> make_plan(const MacroJob& job, const Budgets& budgets);

/// Returns all packets of an upload, the greeting first, as a session that begins with `first_seq`
/// sends them if nothing fails and the ball counts packets.
std::vector<protocol::Command> packets(const Plan& plan, std::uint8_t first_seq);

Route choose_route(const ProgramJob& job, const Capabilities& ball);
Route choose_route(const MacroJob& job);
std::string_view to_string(Route route);

/// Returns the content of the next packet of an Append step, after `sent` bytes in `piece` pieces:
/// as much as fits, or slightly less if one bit error in DLEN would make it a valid shorter packet.
ByteView next_piece(const Step& step, std::size_t sent, std::size_t piece, std::uint8_t seq);
/// Returns the payload of that packet.
Bytes piece_data(const Step& step, ByteView piece);

/// Returns the default kind of a macro: a user macro if the image has a user id, a stream if it has
/// the stream's id, otherwise a temporary macro, or a stream if it is too long for that.
MacroKind natural_kind(const protocol::MacroImage& image);

} // namespace orb::uploader
