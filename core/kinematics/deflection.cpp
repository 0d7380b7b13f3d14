#include "core/kinematics/deflection.h"

#include "core/base/scalar.h"

namespace tubesight::core::kinematics {
namespace {

std::size_t at(std::int32_t joint) { return static_cast<std::size_t>(joint); }

constexpr double kMetres = 1e-3;  // of a millimetre

Eigen::Vector3d vector_of(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

Eigen::Vector3d cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}

// Forces with their moment about the base's origin, in N and N m.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();

  void add(const Eigen::Vector3d& more, const Eigen::Vector3d& at_mm) {
    force += more;
    moment += cross(at_mm * kMetres, more);
  }
  [[nodiscard]] Eigen::Vector3d moment_about(const Eigen::Vector3d& at_mm) const {
    return moment - cross(at_mm * kMetres, force);
  }
};

// Turns all beyond `at_mm` by `turn`.
void turn_about(const Eigen::Vector3d& turn, const Eigen::Vector3d& at_mm,
                const Eigen::Vector3d& tip_mm, Deflection& sum) {
  sum.turn_rad += turn;
  sum.shift_mm += cross(turn, tip_mm - at_mm);
}

void bend(const Eigen::Vector3d& near_mm, const Eigen::Vector3d& far_mm, const Wrench& beyond,
          double bend_per_nm2, double twist_per_nm2, const Eigen::Vector3d& tip_mm,
          Deflection& sum) {
  const Eigen::Vector3d way = (far_mm - near_mm) * kMetres;
  const double length = square_root(way.squaredNorm());
  if (length <= 0.0) {
    return;
  }
  const Eigen::Vector3d along = way / length;
  const Eigen::Vector3d moment = beyond.moment_about(far_mm);
  const Eigen::Vector3d twist = along * along.dot(moment);
  const Eigen::Vector3d across = moment - twist;
  const Eigen::Vector3d lever = cross(along, beyond.force);  // moment gained by a metre inwards
  const Eigen::Vector3d slope = bend_per_nm2 * (across * length + lever * (0.5 * length * length));
  const Eigen::Vector3d sag =
      bend_per_nm2 *
      cross(across * (0.5 * length * length) + lever * (length * length * length / 3.0), along);
  sum.shift_mm += sag / kMetres;
  turn_about(slope + twist * (twist_per_nm2 * length), far_mm, tip_mm, sum);
}

}  // namespace

Deflection deflection(const SerialArm& arm, const JointVector& angles_rad,
                      const Flexibility& flexibility, const Load& load) {
  const LinkFrames frames = arm.link_frames(angles_rad);
  const std::int32_t joints = arm.joints();
  const Transform<frames::Base, frames::Tool> T_base_tool = frames[at(joints)] * arm.T_last_tool();
  const Eigen::Vector3d& tip_mm = T_base_tool.translation_mm();
  const Eigen::Vector3d gravity = vector_of(load.gravity_m_s2);

  Deflection sum;
  Wrench wrench;
  wrench.add(vector_of(load.tip_force_n), tip_mm);
  wrench.add(load.tool_mass_kg * gravity, T_base_tool * vector_of(load.tool_center_mm));
  // From the tool inwards: each link feels what hangs beyond it, each joint its link as well.
  for (std::int32_t i = joints - 1; i >= 0; --i) {
    const Eigen::Vector3d near_mm = frames[at(i)].translation_mm();
    const Eigen::Vector3d far_mm = frames[at(i + 1)].translation_mm();
    bend(near_mm, far_mm, wrench, flexibility.link_bend_per_nm2[at(i)],
         flexibility.link_twist_per_nm2[at(i)], tip_mm, sum);
    wrench.add(load.link_mass_kg[at(i)] * gravity, 0.5 * (near_mm + far_mm));
    const Eigen::Vector3d moment = wrench.moment_about(near_mm);
    const Eigen::Vector3d axis = frames[at(i)].rotation().col(2);
    const Eigen::Vector3d about = axis * axis.dot(moment);
    turn_about(flexibility.joint_rad_per_nm[at(i)] * about +
                   flexibility.connection_rad_per_nm[at(i)] * (moment - about),
               near_mm, tip_mm, sum);
  }
  turn_about(flexibility.support_rad_per_nm * wrench.moment, Eigen::Vector3d::Zero(), tip_mm, sum);
  return sum;
}

Eigen::Matrix3d small_turn(const Eigen::Vector3d& turn_rad) {
  // The unit quaternion along (1, turn / 2).
  const Eigen::Vector3d half = 0.5 * turn_rad;
  const double scale = 2.0 / (1.0 + half.squaredNorm());
  Eigen::Matrix3d skew;
  skew << 0.0, -half.z(), half.y(),  //
      half.z(), 0.0, -half.x(),      //
      -half.y(), half.x(), 0.0;
  return Eigen::Matrix3d::Identity() + scale * (skew + skew * skew);
}

Transform<frames::Base, frames::Tool> deflected(
    const Transform<frames::Base, frames::Tool>& T_base_tool, const Deflection& deflection) {
  return {small_turn(deflection.turn_rad) * T_base_tool.rotation(),
          T_base_tool.translation_mm() + deflection.shift_mm};
}

}  // namespace tubesight::core::kinematics
