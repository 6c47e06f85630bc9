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

/// What an upload must know of the ball's firmware.
struct Capabilities {
  std::size_t ram_bytes = 0; ///< of the orbBasic RAM area, the final NUL included
  std::size_t flash_bytes = 0;
  bool has_basic = false;
  spec::BasicVersion language{};    ///< of its orbBasic, where it has one
  std::uint8_t macro_executive = 0; ///< its version, as in spec/macro.def; 0: not told
  bool can_commit = false;          ///< Commit RAM Program to Flash exists (API 1.47)
  bool in_bootloader = false;       ///< it has no firmware, or does not run it: nothing else works
};

/// Reads an answer of Get Versioning. A record of 8 bytes is from before API 1.46, unless its
/// orbBasic is younger. Source: API §Get Versioning and its history of revisions, M107.
Capabilities read_capabilities(ByteView version_record);

/// Those that are assumed where no ball is asked: of the newest firmware.
Capabilities default_capabilities();

/// A program as it goes to the ball: text with its final NUL.
struct ProgramJob {
  Bytes image;
  Area area = Area::Ram;
  std::optional<std::uint16_t> start_line; ///< runs it from there
};

enum class MacroKind : std::uint8_t { Temporary, User, Stream };

struct MacroJob {
  protocol::MacroImage image;
  MacroKind kind = MacroKind::Temporary;
  bool run = false;          ///< a stream runs as it arrives in any case
  bool clear_others = false; ///< forget every user macro first
};

/// The way a thing is brought to the ball.
enum class Route : std::uint8_t {
  Ram,             ///< a program into RAM
  RamThenFlash,    ///< into RAM, then committed: flash changes at once or not at all
  FlashDirectly,   ///< erased and written in flash: a failure loses the old program
  TemporaryPacket, ///< a temporary macro in one packet
  TemporaryChunks, ///< a longer one in chunks
  UserMacro,       ///< a macro under its own id
  StreamedMacro    ///< a macro of any length, played while it arrives
};

/// What a step is to the upload that carries the plan out.
enum class StepKind : std::uint8_t {
  Prepare, ///< harmless twice, and changes nothing that is stored
  Erase,   ///< what was stored is gone
  Count,   ///< how many packets the ball has received, where it says so
  Append,  ///< the content in pieces, each of which must arrive exactly once
  Barrier, ///< after the content: all answers have come, and the count fits
  Store,   ///< makes it last: commit, save
  Start    ///< runs it
};

struct Step {
  StepKind kind = StepKind::Prepare;
  spec::ApiCommand command{};
  Bytes data{};                    ///< the payload; of Append what stands before each piece
  Bytes content{};                 ///< of Append
  std::vector<std::size_t> cuts{}; ///< the sizes of its pieces; none: as much as a packet carries
};

/// What is done after the greeting when nothing goes wrong, and the time by which an upload has
/// ended whatever goes wrong.
struct Plan {
  Route route = Route::Ram;
  std::vector<Step> steps;
  int attempts = 1;                        ///< how often the steps up to the Barrier may be done
  std::size_t size = 0;                    ///< bytes of the program or macro
  std::size_t pieces = 1;                  ///< packets that carry them, where none is shortened
  std::size_t link_pieces = 0;             ///< of all packets, on a link that takes them in pieces
  Duration expected{};                     ///< about how long it takes when nothing goes wrong
  Duration deadline{};                     ///< from the first attempt to open the link
  std::string note;                        ///< what the user should know of the route; may be empty
  std::string_view again = "upload again"; ///< what helps after a failure
};

/// Why something cannot be uploaded to this ball at all: a sentence.
struct PlanError {
  std::string message;
};

tl::expected<Plan, PlanError> make_plan(const ProgramJob& job, const Capabilities& ball,
                                        const Budgets& budgets);
tl::expected<Plan, PlanError> make_plan(const MacroJob& job, const Budgets& budgets);

/// Every packet of an upload, the greeting first, as a session that begins with `first_seq` sends
/// them to a ball that counts when nothing goes wrong.
std::vector<protocol::Command> packets(const Plan& plan, std::uint8_t first_seq);

Route choose_route(const ProgramJob& job, const Capabilities& ball);
Route choose_route(const MacroJob& job);
std::string_view to_string(Route route);

/// The content that the next packet of an Append step carries, where `sent` bytes in `piece` pieces
/// went before: all that fits, or a little less where one bit error in DLEN would make a valid
/// shorter packet of it.
ByteView next_piece(const Step& step, std::size_t sent, std::size_t piece, std::uint8_t seq);
/// The payload of the packet that carries it.
Bytes piece_data(const Step& step, ByteView piece);

/// The kind of macro that is meant where the user names none: a user macro where the image has a
/// user id, a stream where it has the stream's, else a temporary one, else, where it is too long
/// for that, a stream.
MacroKind natural_kind(const protocol::MacroImage& image);

} // namespace orb::uploader
