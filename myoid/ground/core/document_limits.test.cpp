#include "myoid/ground/core/document_limits.h"

#include <string>

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

std::string times(const std::string& text, std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

TEST(DocumentLimits, JsonMayNestAsDeepAsTheLimitAndNoDeeper) {
  const auto nested = [](std::size_t depth) { return times("[", depth) + times("]", depth); };
  EXPECT_FALSE(json_fault(nested(kDeepestNesting)));
  ASSERT_TRUE(json_fault(nested(kDeepestNesting + 1)));
  EXPECT_EQ(json_fault(nested(kDeepestNesting + 1))->offset, kDeepestNesting);
  EXPECT_TRUE(json_fault(times("{\"a\":", kDeepestNesting + 1)));
}

TEST(DocumentLimits, BracketsInStringsAndSideBySideAreNoNesting) {
  EXPECT_FALSE(json_fault("{\"name\":\"\\\"" + times("[", 1000) + "\"}"));
  EXPECT_FALSE(json_fault("[" + times("[],", 1000) + "0]"));
}

TEST(DocumentLimits, XmlMayNestAsDeepAsTheLimitAndNoDeeper) {
  const auto nested = [](std::size_t depth) { return times("<a b='>'>", depth) + times("</a>", depth); };
  EXPECT_FALSE(xml_fault(nested(kDeepestNesting)));
  ASSERT_TRUE(xml_fault(nested(kDeepestNesting + 1)));
  EXPECT_EQ(xml_fault(nested(kDeepestNesting + 1))->offset, 9 * kDeepestNesting);
}

TEST(DocumentLimits, CommentsSectionsAndEmptyElementsAreNoNesting) {
  const std::string tags = times("<a>", 1000);
  EXPECT_FALSE(xml_fault("<?xml version='1.0'?><m><!-- " + tags + " --><![CDATA[" + tags + "]]>" +
                         times("<b c=\"<a>\"/>", 1000) + "<t>1</t></m>"));
  EXPECT_FALSE(xml_fault("<!DOCTYPE m><m>" + times("<a>1</a>\n", 1000) + "</m>"));
}

TEST(DocumentLimits, CutOffTextsEnd) {
  for (const char* cut : {"<", "<a", "<!--", "<a b='", "<![CDATA[", "</", "<?", ""})
    EXPECT_FALSE(xml_fault(cut)) << cut;
  EXPECT_FALSE(json_fault("\"\\"));
}

TEST(DocumentLimits, ALargeDocumentIsRefused) {
  const std::string large(kLargestDocument_bytes + 1, ' ');
  EXPECT_TRUE(json_fault(large));
  EXPECT_TRUE(xml_fault(large));
}

}  // namespace
}  // namespace myoid::inline ground
