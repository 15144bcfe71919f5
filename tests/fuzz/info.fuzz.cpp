// The description of a file of any kind, as `myoid info` prints it, in text and in JSON. The first
// byte chooses the ending of the file's name.
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/program/contents/contents_text.h"
#include "myoid/program/contents/model_contents.h"
#include "myoid/program/contents/recording_contents.h"

#include "fuzz.h"
#include "info_kinds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace fuzz = myoid::fuzz;
  if (size == 0) return 0;
  const std::size_t kind = (data[0] - std::size_t{'a'}) % fuzz::kInfoKinds.size();
  const std::string name = "f" + std::string(fuzz::kInfoKinds[kind]);
  const auto path = fuzz::folder() / name;
  fuzz::write(name, fuzz::text(data + 1, size - 1));
  try {
    auto contents = myoid::program::recording_contents(path);
    if (!contents) contents = myoid::program::model_contents(myoid::body::read_osim(path));
    fuzz::require(!myoid::program::contents_text(*contents).empty());
    fuzz::require(!myoid::json_text(*contents).empty());
  } catch (const myoid::ReadError&) {
  } catch (const myoid::ModelError&) {
  }
  return 0;
}
