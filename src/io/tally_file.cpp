#include "io/tally_file.hpp"

#include "io/h5.hpp"

namespace freestand::io {

void write_tally(const std::filesystem::path& path, const TallyContent& content) {
  h5::File file = h5::File::create(path);
  h5::Group root = file.root();
  write_provenance(root, tally_format, content.provenance);
  h5::Dataset words = root.make_group("tally").put("words", content.words);
  words.describe("1", "counts, and sums in units of 2^-40 split into four parts each, over all samples");
  words.attribute("fingerprint", content.fingerprint);
  file.finish();
}

TallyContent read_tally(const std::filesystem::path& path) {
  const h5::File file = h5::File::open(path);
  TallyContent content{read_provenance(file.root(), tally_format), {}, {}};
  const h5::Dataset words = file.root().open_group("tally").open_dataset("words");
  content.fingerprint = words.text_attribute("fingerprint");
  content.words = words.read_integers();
  return content;
}

}  // namespace freestand::io
