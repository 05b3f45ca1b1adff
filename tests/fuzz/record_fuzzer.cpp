// summary.json is read, or refused with FileError. What is read can be written, and be read again.
#include "core/errors.hpp"
#include "output/run_record.hpp"
#include "tests/fuzz/input.hpp"

using namespace undex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path path = fuzz::written("summary.json", fuzz::text_of(data, size));
  std::string once;
  try {
    once = output::to_json(output::read_summary(path));
  } catch (const FileError&) {
    return 0;
  }
  const std::string twice = output::to_json(output::read_summary(fuzz::written("again.json", once)));
  fuzz::require(once == twice, "a record is read back as it was written");
  return 0;
}
