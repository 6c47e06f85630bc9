#include "playground/engine/uploads.h"

#include "base/text/utf8.h"
#include "playground/engine/log_link.h"

#include "run/began.h"
#include "run/delivery.h"
#include "run/lacks.h"
#include "spec/ble.h"
#include "spec/robots.h"
#include "spec/serial.h"
#include "uploader/ble.h"

#include <fmt/format.h>
#include <memory>
#include <utility>

namespace orb::playground {
namespace {

/// Remembers the last progress report.
class Last final : public uploader::Progress {
public:
  void on_item(std::string_view name) override { item_ = name; }
  void on_status(const uploader::Status& status, Instant) override { status_ = status; }

  ordered_json json() const {
    return {{"item", item_},
            {"stage", uploader::to_string(status_.stage)},
            {"bytes", status_.bytes_sent},
            {"bytes_total", status_.bytes_total},
            {"packets", status_.packets},
            {"packets_total", status_.packets_total},
            {"attempt", status_.attempt}};
  }

private:
  std::string item_;
  uploader::Status status_;
};

std::string_view word(uploader::Report::Kind kind) {
  switch (kind) {
  case uploader::Report::Kind::Done: return "done";
  case uploader::Report::Kind::Impossible: return "impossible";
  case uploader::Report::Kind::Refused: return "refused";
  case uploader::Report::Kind::NoBall: return "no-ball";
  case uploader::Report::Kind::LinkLost: return "link-lost";
  case uploader::Report::Kind::Unknown: return "unknown";
  case uploader::Report::Kind::Interrupted: return "interrupted";
  }
  return "";
}

ordered_json place_json(spec::BleCharacteristic characteristic) {
  const auto& row = spec::info(characteristic);
  return {{"service", spec::ble_services[static_cast<std::size_t>(row.service)].uuid},
          {"characteristic", row.uuid}};
}

/// How to find a robot and open it to commands.
ordered_json ble_json(const uploader::Budgets& budgets, spec::BleProtocol protocol) {
  const bool is_v1 = protocol == spec::BleProtocol::V1;
  auto services = ordered_json::array();
  for (const auto& row : spec::ble_services)
    if (row.protocol == protocol)
      services.push_back(row.uuid);
  auto names = ordered_json::array();
  for (const auto& row : spec::ble_names)
    if (row.protocol == protocol)
      names.push_back(row.prefix);
  auto greeting = ordered_json::array();
  for (const auto& row : spec::ble_greeting) {
    if (spec::protocol_of(row.characteristic) != protocol)
      continue;
    greeting.push_back(place_json(row.characteristic));
    greeting.back()["bytes"] = bytes_json(as_bytes(row.bytes));
  }
  auto open = ordered_json::array(); // names of robots without such a characteristic
  for (const auto& row : spec::ble_names)
    if (spec::is_open(row.model))
      open.push_back(row.prefix);
  return {{"services", services},
          {"names", names},
          {"greeting", greeting},
          {"wordless", open},
          {"commands", place_json(is_v1 ? spec::BleCharacteristic::Commands
                                        : spec::BleCharacteristic::PacketsV2)},
          {"answers", place_json(is_v1 ? spec::BleCharacteristic::Answers
                                       : spec::BleCharacteristic::PacketsV2)},
          {"piece", spec::ble_piece_bytes},
          {"connect_ms", milliseconds(budgets.ble_connect)},
          {"write_ms", milliseconds(budgets.ble_send)}};
}

} // namespace

Answer links(Request&) {
  const uploader::Budgets budgets;
  auto pauses = ordered_json::array(); // between attempts
  for (int n = 1; n < budgets.opens; ++n)
    pauses.push_back(milliseconds(budgets.backoff(n)));
  return print(
      {{"pauses_ms", pauses},
       {"serial",
        {{"baud_rate", spec::serial_baud_rate}, {"write_ms", milliseconds(budgets.write)}}},
       {"ble", ble_json(budgets, spec::BleProtocol::V1)},
       {"newer", ble_json(budgets, spec::BleProtocol::V2)}});
}

tl::expected<Upload, Problem> Upload::start(Request& request) {
  auto read = request.inputs();
  if (!read)
    return tl::unexpected(read.error());
  const auto inputs = std::make_shared<const std::vector<run::Input>>(*std::move(read));
  run::DeliveryOptions options;
  options.area = request.text("area", "ram") == "flash" ? spec::Area::Flash : spec::Area::Ram;
  options.run = request.flag("run");
  options.line = request.value<std::uint16_t>("line");
  options.clear_macros = request.flag("clear_macros");
  auto delivery = run::arrange(*inputs, options);
  if (!delivery)
    return refuse(delivery.error());
  delivery->misfit = [inputs](const uploader::Greeting& ball) -> std::optional<std::string> {
    const auto lacks = run::lacks_of(*inputs, ball.firmware);
    return lacks.empty() ? std::nullopt : std::optional(run::in_words(lacks, ball));
  };
  Upload upload;
  upload.delivery_ = *std::move(delivery);
  if (const auto* program = run::first_with_program(*inputs); options.run && program != nullptr)
    upload.lines_ = program->program->lines; // a macro reports nothing when it fails
  upload.battery_ =
      request.flag("force") ? uploader::BatteryPolicy::Ignore : uploader::BatteryPolicy::Refuse;
  if (request.text("link") == "ble")
    upload.budgets_ = uploader::ble_budgets(upload.budgets_);
  upload.first_seq_ = request.value<std::uint8_t>("first_seq").value_or(0);
  return upload;
}

std::string Upload::step(const ordered_json& done) {
  if (done.contains("at"))
    log_.push_back(read_done(done));
  return next();
}

std::string Upload::next() {
  LogLink link(log_);
  Last progress;
  uploader::Session session(link, budgets_, first_seq_);
  auto report = uploader::deliver(session, delivery_, battery_, progress);
  bool stopped = false;
  if (lines_ && report.kind == uploader::Report::Kind::Done) {
    const auto began = run::watch_start(session, *lines_);
    stopped = began.fault.has_value();
    report.message = stopped ? began.words : fmt::format("{}; {}", report.message, began.words);
  }
  if (!link.wish().is_null())
    return print({{"wish", link.wish()}, {"status", progress.json()}});
  std::string prints;
  for (const auto& message : session.inbox())
    if (message.id == static_cast<std::uint8_t>(spec::AsyncId::BasicPrint))
      prints += as_text(message.data);
  const auto code = stopped ? ExitCode::BadInput : uploader::exit_code(report.kind);
  return print({{"outcome",
                 {{"kind", stopped ? "stopped" : word(report.kind)},
                  {"code", static_cast<int>(code)},
                  {"message", report.message},
                  {"prints", from_latin1(prints)},
                  {"packets", session.counts().packets_out},
                  {"ms", milliseconds(link.now().time_since_epoch())}}}});
}

namespace {

using spec::ApiCommand;

/// Stops programs, macros and the wheels in this order, so that nothing can start driving again.
constexpr ApiCommand stops[] = {ApiCommand::AbortOrbbasicProgram, ApiCommand::AbortMacro,
                                ApiCommand::Roll};

Bytes data_of_stop(ApiCommand command) {
  return command == ApiCommand::Roll ? Bytes(4, 0) : Bytes{};
}

Bytes start_of(const uploader::Delivery& delivery, std::uint8_t seq) {
  if (delivery.program) {
    Bytes data{static_cast<std::uint8_t>(delivery.program->area)};
    append_u16(data, delivery.program->start_line.value_or(0));
    return encode(protocol::make_command(ApiCommand::ExecuteOrbbasicProgram, data, seq));
  }
  const auto& job = delivery.macros.front().job;
  const auto id =
      job.kind == uploader::MacroKind::Temporary ? spec::macro_id_temporary : job.image.id;
  return encode(protocol::make_command(ApiCommand::RunMacro, {id}, seq));
}

} // namespace

Answer tell_robot(Request& request) {
  auto seq = request.value<std::uint8_t>("seq").value_or(0);
  Bytes packets;
  if (request.text("what") == "stop") {
    for (const auto command : stops)
      encode(protocol::make_command(command, data_of_stop(command), seq++), packets);
    return print({{"bytes", bytes_json(packets)}});
  }
  const auto inputs = request.inputs();
  if (!inputs)
    return tl::unexpected(inputs.error());
  run::DeliveryOptions options;
  options.area = request.text("area", "ram") == "flash" ? spec::Area::Flash : spec::Area::Ram;
  options.run = true;
  const auto delivery = run::arrange(*inputs, options);
  if (!delivery)
    return refuse(delivery.error());
  return print({{"bytes", bytes_json(start_of(*delivery, seq))}});
}

Answer RobotEar::hear(Request& request) {
  const auto bytes = bytes_of(request.params.at("bytes"));
  std::string prints;
  std::string error;
  decoder_.feed(bytes);
  while (const auto item = decoder_.next()) {
    if (item->kind != protocol::Item::Kind::Async)
      continue;
    if (item->code == static_cast<std::uint8_t>(spec::AsyncId::BasicPrint))
      prints += as_text(item->data);
    else if (item->code == static_cast<std::uint8_t>(spec::AsyncId::BasicErrorText))
      error += as_text(item->data);
  }
  return print({{"prints", from_latin1(prints)}, {"error", from_latin1(error)}});
}

} // namespace orb::playground
