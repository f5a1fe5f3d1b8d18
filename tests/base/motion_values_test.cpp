#include <gtest/gtest.h>

#include <cstdint>
#include <freestand/motion_values.hpp>

namespace freestand {
namespace {

using Own = MotionValues;

class HeldValues : public testing::Test {
 protected:
  std::shared_ptr<std::vector<double>> there_ = std::make_shared<std::vector<double>>(std::vector<double>{1, 2, 3});
  MotionValues reader() const { return MotionValues(3, LineAllocator<double>({there_, there_->data()}, 3)); }
};

TEST_F(HeldValues, AreReadWhereTheyAre) {
  MotionValues values = reader();
  EXPECT_EQ(values.data(), there_->data());
  EXPECT_EQ(values, (Own{1, 2, 3}));
  const MotionValues moved = std::move(values);
  EXPECT_EQ(moved.data(), there_->data());
  MotionValues assigned{9};
  assigned = reader();
  EXPECT_EQ(assigned.data(), there_->data());
}

TEST_F(HeldValues, StayAsLongAsOneReadsThem) {
  const std::weak_ptr<const std::vector<double>> watch = there_;
  {
    const MotionValues values = reader();
    there_.reset();
    EXPECT_EQ(values[2], 3);
  }
  EXPECT_TRUE(watch.expired());
}

TEST_F(HeldValues, AreNotChangedByWhatIsMadeOfThem) {
  MotionValues grown = reader(), copy = grown, assigned{9};
  assigned = grown;
  copy[0] = assigned[0] = 7;
  grown.push_back(4);
  grown.resize(6);
  EXPECT_EQ(grown, (Own{1, 2, 3, 4, 0, 0}));
  grown.resize(3);
  grown.shrink_to_fit();
  grown[0] = 8;
  MotionValues left = reader();
  const MotionValues taken = std::move(left);
  left = Own(3, 5.0);  // NOLINT: a vector that was moved from may be used again
  left.assign(3, 6.0);
  EXPECT_EQ(*there_, (std::vector<double>{1, 2, 3}));
}

TEST(MotionValues, StartWhereACacheLineDoes) {
  for (std::size_t n = 1; n < 20; ++n) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(MotionValues(n).data()) % 64, 0u);
}

}  // namespace
}  // namespace freestand
