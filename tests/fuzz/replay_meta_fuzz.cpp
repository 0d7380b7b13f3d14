// Meta files: whatever the text, either rows in the order of their fields, or messages.
#include "drivers/replay/replay_meta.h"

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tubesight;
  drivers::ReplayMeta meta;
  drivers::Messages messages;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const bool good = meta.parse(text, "fuzz.meta.csv", messages).has_value();
  require(good == messages.empty());
  for (const std::string& message : messages) {
    require(message.find('\n') == std::string::npos && message.starts_with("fuzz.meta.csv:"));
  }
  const drivers::FieldMeta* before = nullptr;
  const drivers::FieldMeta* came = nullptr;  // the last row of a field that came
  for (const drivers::FieldMeta& row : meta.rows()) {
    require(row.field >= 0 && meta.find(row.field) == &row);
    require(row.lamp_permille.value_or(0) >= 0 && row.lamp_permille.value_or(0) <= 1000);
    require(before == nullptr || row.field > before->field);
    if (row.status == core::FieldStatus::kMissing) {
      require(!good || before == nullptr || row.time > before->time);
    } else {
      // One that comes late may be older than the giving up of those before it.
      require(!good || came == nullptr || (row.time > came->time && row.sequence > came->sequence));
      came = &row;
    }
    before = &row;
  }
  return 0;
}
