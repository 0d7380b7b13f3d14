#include "core/kinematics/arm_errors.h"

#include <cmath>

#include "core/base/static_vector.h"
#include "core/base/trigonometry.h"
#include "core/math/split_mix.h"

namespace tubesight::core::kinematics {
namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : bits_(seed) {}

  double normal(double sigma) {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
      sum += static_cast<double>(bits_.next() >> 11) * 0x1p-53;
    }
    return sigma * sum;
  }
  PoseError pose(double sigma_mm, double sigma_deg) {
    PoseError error;
    for (double& mm : error.position_mm) {
      mm = normal(sigma_mm);
    }
    for (double& deg : error.rotation_deg) {
      deg = normal(sigma_deg);
    }
    return error;
  }

 private:
  math::SplitMix64 bits_;
};

template <typename Frame>
Transform<Frame, Frame> transform_of(const PoseError& error) {
  return {rotation_from_degrees(error.rotation_deg),
          Eigen::Vector3d(error.position_mm[0], error.position_mm[1], error.position_mm[2])};
}

void add(const JointVector& more, JointVector& sum) {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] += more[i];
  }
}

}  // namespace

ErrorMagnitudes installed_magnitudes() {
  ErrorMagnitudes m = calibrated_magnitudes();
  m.base_mm = 5.0;
  m.base_deg = 0.3;
  return m;
}

ErrorMagnitudes calibrated_magnitudes() {
  ErrorMagnitudes m;
  m.base_mm = 0.5;  // docking is right to about that [Fallon sec. 5.3]
  m.base_deg = 0.02;
  m.length_mm = 0.2;
  m.twist_deg = 0.01;
  m.zero_deg = 0.02;
  m.resolution_deg = 360.0 / 65536.0;  // a synchro read with 16 bits
  m.backlash_deg = 0.01;
  m.tool_mm = 0.3;
  m.tool_deg = 0.05;
  m.workpiece_mm = 0.3;
  m.workpiece_deg = 0.01;
  m.support_mm = 0.3;
  m.support_deg = 0.01;
  m.flexibility_share = 0.2;
  m.tool_mass_share = 0.1;
  return m;
}

Flexibility cobra_flexibility() {
  Flexibility flexibility;
  flexibility.support_rad_per_nm = 4e-7;
  flexibility.joint_rad_per_nm = {2e-6, 2e-6, 3e-6, 5e-6, 5e-6, 5e-6, 0.0, 0.0};
  flexibility.connection_rad_per_nm = {2e-7, 2e-7, 4e-7, 1e-6, 1e-6, 1e-6, 0.0, 0.0};
  // Aluminium tubes of 120 and 100 mm across with walls of 4 mm: I = 2.45e-6 and 1.39e-6 m⁴ at 70
  // GPa; for shafts twice that at 26 GPa.
  flexibility.link_bend_per_nm2 = {0.0, 5.8e-6, 1.03e-5, 0.0, 0.0, 0.0, 0.0, 0.0};
  flexibility.link_twist_per_nm2 = {0.0, 7.8e-6, 1.38e-5, 0.0, 0.0, 0.0, 0.0, 0.0};
  return flexibility;
}

Load cobra_load() {
  Load load;
  load.link_mass_kg = {15.0, 15.0, 11.0, 4.0, 3.0, 2.0, 0.0, 0.0};
  load.tool_mass_kg = 8.0;
  load.tool_center_mm = {0.0, 0.0, -120.0};
  return load;
}

ArmErrors draw_errors(const ErrorMagnitudes& magnitudes, const InstalledArm& believed,
                      std::uint64_t seed) {
  Draw draw(seed);
  ArmErrors errors;
  errors.base = draw.pose(magnitudes.base_mm, magnitudes.base_deg);
  errors.tool = draw.pose(magnitudes.tool_mm, magnitudes.tool_deg);
  errors.workpiece = draw.pose(magnitudes.workpiece_mm, magnitudes.workpiece_deg);
  errors.support = draw.pose(magnitudes.support_mm, magnitudes.support_deg);
  errors.tool_mass_kg = draw.normal(magnitudes.tool_mass_share * believed.load.tool_mass_kg);
  const auto share = [&](double value) {
    return draw.normal(magnitudes.flexibility_share * value);
  };
  const Flexibility& flexibility = believed.flexibility;
  errors.flexibility.support_rad_per_nm = share(flexibility.support_rad_per_nm);
  for (std::size_t i = 0; i < errors.links.size(); ++i) {
    LinkError& link = errors.links[i];
    link.a_mm = draw.normal(magnitudes.length_mm);
    link.d_mm = draw.normal(magnitudes.length_mm);
    link.twist_rad = draw.normal(radians(magnitudes.twist_deg));
    link.offset_rad = draw.normal(radians(magnitudes.zero_deg));
    errors.drive.resolution_rad[i] = radians(magnitudes.resolution_deg);
    errors.drive.backlash_rad[i] = radians(magnitudes.backlash_deg);
    errors.flexibility.joint_rad_per_nm[i] = share(flexibility.joint_rad_per_nm[i]);
    errors.flexibility.connection_rad_per_nm[i] = share(flexibility.connection_rad_per_nm[i]);
    errors.flexibility.link_bend_per_nm2[i] = share(flexibility.link_bend_per_nm2[i]);
    errors.flexibility.link_twist_per_nm2[i] = share(flexibility.link_twist_per_nm2[i]);
  }
  return errors;
}

Result<InstalledArm> true_arm(const InstalledArm& believed, const ArmErrors& errors) {
  StaticVector<Link, kMaxJoints> links;
  for (std::int32_t i = 0; i < believed.arm.joints(); ++i) {
    Link link = believed.arm.links()[static_cast<std::size_t>(i)];
    const LinkError& error = errors.links[static_cast<std::size_t>(i)];
    link.a_mm += error.a_mm;
    link.d_mm += error.d_mm;
    link.twist_rad += error.twist_rad;
    link.offset_rad += error.offset_rad;
    static_cast<void>(links.try_push_back(link));  // as many as the believed arm has
  }
  const auto arm = SerialArm::make(
      links.view(), transform_of<LinkFrame>(errors.tool) * believed.arm.T_last_tool());
  if (!arm) {
    return Unexpected(arm.error());
  }
  InstalledArm installed = believed;
  installed.arm = *arm;
  installed.T_sheet_base = transform_of<frames::Sheet>(errors.workpiece) *
                           transform_of<frames::Sheet>(errors.support) * believed.T_sheet_base *
                           transform_of<frames::Base>(errors.base);
  installed.flexibility.support_rad_per_nm += errors.flexibility.support_rad_per_nm;
  add(errors.flexibility.joint_rad_per_nm, installed.flexibility.joint_rad_per_nm);
  add(errors.flexibility.connection_rad_per_nm, installed.flexibility.connection_rad_per_nm);
  add(errors.flexibility.link_bend_per_nm2, installed.flexibility.link_bend_per_nm2);
  add(errors.flexibility.link_twist_per_nm2, installed.flexibility.link_twist_per_nm2);
  installed.load.tool_mass_kg += errors.tool_mass_kg;
  const bool good = installed.T_sheet_base.rotation().allFinite() &&
                    installed.T_sheet_base.translation_mm().allFinite() &&
                    std::isfinite(installed.load.tool_mass_kg);
  return good ? Result<InstalledArm>(installed) : Unexpected(Error::kInvalidArgument);
}

}  // namespace tubesight::core::kinematics
