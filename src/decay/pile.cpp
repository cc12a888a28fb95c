#include "decay/pile.h"

#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/error.h"
#include "geometry/layered_mesh.h"

namespace windfall::decay {

namespace {

using geometry::Vec3;

/// Bullet is made for things of about a metre: lengths are enlarged so much.
constexpr double kBulletUnitsPerMetre = 20;
/// Bullet rounds convex bodies by a margin; their corners are drawn in by as much.
constexpr double kMargin_m = 0.5e-3;
constexpr int kHullCells = 4;
constexpr double kStep_s = 1.0 / 240;
constexpr double kLongest_s = 60;
constexpr double kBetweenDrops_s = 0.5;
/// At rest is what has moved no farther than kAtRest_m in kStill_s: speeds alone would show the solver's
/// tremble.
constexpr double kAtRest_m = 0.2e-3;
constexpr int kStillSteps = 120;
/// Damping grows to the second value in so many seconds after the last drop, which brings every pile to rest.
constexpr double kLinearDamping[2] = {0.1, 0.9};
constexpr double kAngularDamping[2] = {0.4, 0.99};
constexpr double kCalming_s = 4;
constexpr double kContactGap_m = 1.5e-3;

btVector3 to_bullet(const Vec3& x) {
    const Vec3 y = kBulletUnitsPerMetre * x;
    return {static_cast<btScalar>(y.x()), static_cast<btScalar>(y.y()), static_cast<btScalar>(y.z())};
}

Vec3 direction_from(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 point_from(const btVector3& v) { return direction_from(v) / kBulletUnitsPerMetre; }

/// A hash of (seed, fruit, which) in [0, 1): splitmix64 (Steele, Lea, Flood 2014).
double drop_random(std::uint64_t seed, std::size_t fruit, std::uint64_t which) {
    std::uint64_t z = seed * 0x9E3779B97F4A7C15U + fruit * 0xD1B54A32D192ED03U + which * 0x8CB92BA72F3D8DD7U;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
}

/// Uniform over all rotations (Shoemake 1992).
Eigen::Quaterniond random_rotation(std::uint64_t seed, std::size_t fruit) {
    const double u = drop_random(seed, fruit, 1);
    const double a = 2 * std::numbers::pi * drop_random(seed, fruit, 2);
    const double b = 2 * std::numbers::pi * drop_random(seed, fruit, 3);
    return {std::sqrt(u) * std::cos(b), std::sqrt(1 - u) * std::sin(a), std::sqrt(1 - u) * std::cos(a),
            std::sqrt(u) * std::sin(b)};
}

/// Convex hull about its centre, which Bullet takes for the centre of mass.
struct Hull {
    Vec3 centre;
    double radius_m = 0;  ///< of the sphere around it
    std::unique_ptr<btConvexHullShape> shape;
};

Hull hull_of(const SurfaceFunction& surface) {
    const auto brick = geometry::make_brick_surface({kHullCells, kHullCells, kHullCells});
    std::vector<Vec3> points;
    for (const Vec3& d : geometry::brick_directions(brick, Vec3::Ones())) points.push_back(surface(d));
    const std::vector<geometry::Face> faces(brick.quads.begin(), brick.quads.end());
    const auto areas = geometry::vertex_areas(points, faces);
    Hull hull{Vec3::Zero(), 0, std::make_unique<btConvexHullShape>()};
    double total = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        hull.centre += areas[i] * points[i];
        total += areas[i];
    }
    hull.centre /= total;
    for (const Vec3& x : points) {
        const Vec3 from_centre = x - hull.centre;
        hull.radius_m = std::max(hull.radius_m, from_centre.norm());
        hull.shape->addPoint(to_bullet(from_centre * (1 - kMargin_m / from_centre.norm())), false);
    }
    hull.shape->recalcLocalAabb();
    hull.shape->setMargin(static_cast<btScalar>(kMargin_m * kBulletUnitsPerMetre));
    return hull;
}

/// Inner side of the bowl as triangles.
std::unique_ptr<btTriangleMesh> bowl_mesh(const PileSettings& settings) {
    constexpr int kRings = 8;
    constexpr int kSectors = 36;
    const double rim_angle = std::acos(1 - settings.bowl_height_m / settings.bowl_radius_m);
    const auto point = [&](int ring, int sector) {
        const double polar = rim_angle * ring / kRings;
        const double around = 2 * std::numbers::pi * sector / kSectors;
        const Vec3 down(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
                        -std::cos(polar));
        return to_bullet(settings.bowl_radius_m * (down + Vec3::UnitZ()));
    };
    auto mesh = std::make_unique<btTriangleMesh>();
    for (int ring = 0; ring < kRings; ++ring)
        for (int sector = 0; sector < kSectors; ++sector) {
            mesh->addTriangle(point(ring, sector), point(ring + 1, sector), point(ring + 1, sector + 1));
            if (ring > 0)
                mesh->addTriangle(point(ring, sector), point(ring + 1, sector + 1), point(ring, sector + 1));
        }
    return mesh;
}

/// Bullet's world with all that it points to, in the order in which it may be taken apart.
class DropWorld {
  public:
    explicit DropWorld(const PileSettings& settings)
        : m_settings(settings),
          m_dispatcher(&m_configuration),
          m_world(&m_dispatcher, &m_broadphase, &m_solver, &m_configuration),
          m_table(btVector3(0, 0, 1), 0) {
        m_world.setGravity({0, 0, static_cast<btScalar>(-9.81 * kBulletUnitsPerMetre)});
        add_ground(m_table);
        if (settings.bowl_radius_m > 0) {
            m_bowl_mesh = bowl_mesh(settings);
            m_bowl = std::make_unique<btBvhTriangleMeshShape>(m_bowl_mesh.get(), true);
            m_bowl->setMargin(static_cast<btScalar>(kMargin_m * kBulletUnitsPerMetre));
            add_ground(*m_bowl);
        }
    }
    DropWorld(const DropWorld&) = delete;
    DropWorld& operator=(const DropWorld&) = delete;
    ~DropWorld() {
        for (auto& body : m_ground) m_world.removeRigidBody(body.get());
        for (auto& body : m_bodies) m_world.removeRigidBody(body.get());
    }

    void drop(Hull hull, double mass_kg, const Eigen::Quaterniond& rotation, const Vec3& centre_m) {
        const auto mass = static_cast<btScalar>(mass_kg);
        btVector3 inertia(0, 0, 0);
        hull.shape->calculateLocalInertia(mass, inertia);
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, hull.shape.get(), inertia);
        info.m_startWorldTransform = btTransform(
            btQuaternion(static_cast<btScalar>(rotation.x()), static_cast<btScalar>(rotation.y()),
                         static_cast<btScalar>(rotation.z()), static_cast<btScalar>(rotation.w())),
            to_bullet(centre_m));
        info.m_friction = static_cast<btScalar>(m_settings.friction);
        // Real fruit are neither round nor hard: they do not roll for long.
        info.m_rollingFriction = static_cast<btScalar>(0.02 * hull.radius_m * kBulletUnitsPerMetre);
        info.m_spinningFriction = info.m_rollingFriction;
        info.m_linearDamping = static_cast<btScalar>(kLinearDamping[0]);
        info.m_angularDamping = static_cast<btScalar>(kAngularDamping[0]);
        auto body = std::make_unique<btRigidBody>(info);
        body->setUserIndex(static_cast<int>(m_bodies.size()));
        body->setActivationState(DISABLE_DEACTIVATION);
        m_world.addRigidBody(body.get());
        m_bodies.push_back(std::move(body));
        m_hulls.push_back(std::move(hull));
    }

    void step() { m_world.stepSimulation(kStep_s, 0); }

    /// 0: the damping that fruit are dropped with .. 1: the strongest.
    void calm(double share) {
        const auto at = [share](const double range[2]) {
            return static_cast<btScalar>(range[0] + share * (range[1] - range[0]));
        };
        for (auto& body : m_bodies) body->setDamping(at(kLinearDamping), at(kAngularDamping));
    }

    /// Farthest that any point of a fruit has moved between two sets of poses.
    double farthest_m(const std::vector<FruitPose>& before) const {
        double farthest = 0;
        for (std::size_t i = 0; i < m_bodies.size(); ++i) {
            const FruitPose now = pose(i);
            const Vec3& c = m_hulls[i].centre;
            const Vec3 moved =
                (now.rotation * c + now.translation_m) - (before[i].rotation * c + before[i].translation_m);
            farthest = std::max(farthest, moved.norm() + m_hulls[i].radius_m * now.rotation.angularDistance(
                                                                                   before[i].rotation));
        }
        return farthest;
    }

    std::vector<FruitPose> poses() const {
        std::vector<FruitPose> result;
        for (std::size_t i = 0; i < m_bodies.size(); ++i) result.push_back(pose(i));
        return result;
    }

    FruitPose pose(std::size_t fruit) const {
        const btTransform& at = m_bodies[fruit]->getWorldTransform();
        const btQuaternion q = at.getRotation();
        FruitPose pose;
        pose.rotation = Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized();
        pose.translation_m = point_from(at.getOrigin()) - pose.rotation * m_hulls[fruit].centre;
        return pose;
    }

    std::vector<PileContact> contacts() {
        std::vector<PileContact> result;
        for (int m = 0; m < m_dispatcher.getNumManifolds(); ++m) {
            const btPersistentManifold& manifold = *m_dispatcher.getManifoldByIndexInternal(m);
            const int a = manifold.getBody0()->getUserIndex();
            const int b = manifold.getBody1()->getUserIndex();
            for (int k = 0; k < manifold.getNumContacts(); ++k) {
                const btManifoldPoint& p = manifold.getContactPoint(k);
                if (p.getDistance() > kContactGap_m * kBulletUnitsPerMetre) continue;
                // Bullet's normal points from b to a.
                Vec3 normal = direction_from(p.m_normalWorldOnB).normalized();
                const bool swap = a == kPileGround || (b != kPileGround && b < a);
                if (swap) normal = -normal;
                result.push_back({swap ? b : a, swap ? a : b,
                                  point_from((p.getPositionWorldOnA() + p.getPositionWorldOnB()) / 2),
                                  normal});
            }
        }
        std::sort(result.begin(), result.end(), [](const PileContact& x, const PileContact& y) {
            return std::pair(x.fruit, x.other) < std::pair(y.fruit, y.other);
        });
        return result;
    }

  private:
    void add_ground(btCollisionShape& shape) {
        btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, &shape);
        info.m_friction = static_cast<btScalar>(m_settings.friction);
        info.m_rollingFriction = 1;
        info.m_spinningFriction = 1;
        auto body = std::make_unique<btRigidBody>(info);
        body->setUserIndex(kPileGround);
        m_world.addRigidBody(body.get());
        m_ground.push_back(std::move(body));
    }

    PileSettings m_settings;
    btDefaultCollisionConfiguration m_configuration;
    btCollisionDispatcher m_dispatcher;
    btDbvtBroadphase m_broadphase;
    btSequentialImpulseConstraintSolver m_solver;
    btDiscreteDynamicsWorld m_world;
    btStaticPlaneShape m_table;
    std::unique_ptr<btTriangleMesh> m_bowl_mesh;
    std::unique_ptr<btBvhTriangleMeshShape> m_bowl;
    std::vector<Hull> m_hulls;
    std::vector<std::unique_ptr<btRigidBody>> m_ground, m_bodies;
};

void check_pile(const std::vector<Hull>& hulls, const PileSettings& s) {
    if (hulls.empty()) throw InputError("a pile needs at least one fruit");
    if (s.bowl_radius_m == 0) return;
    if (!(s.bowl_height_m > 0 && s.bowl_height_m <= s.bowl_radius_m))
        throw InputError(fmt::format("the bowl's height must be > 0 and at most its radius ({} m), not {} m",
                                     s.bowl_radius_m, s.bowl_height_m));
    for (const Hull& hull : hulls)
        if (hull.radius_m > 0.8 * s.bowl_radius_m)
            throw InputError(
                fmt::format("a fruit of radius {:.3f} m does not fit into a bowl of radius {} m: "
                            "make the bowl larger",
                            hull.radius_m, s.bowl_radius_m));
}

}  // namespace

SettledPile settle_pile(const std::vector<PileFruit>& fruit, const PileSettings& settings,
                        const RunContext& run) {
    std::vector<Hull> hulls;
    double largest = 0;
    for (const PileFruit& f : fruit) {
        hulls.push_back(hull_of(f.surface));
        largest = std::max(largest, hulls.back().radius_m);
    }
    check_pile(hulls, settings);
    // In a bowl they drop near its middle, on a table over a patch that holds them side by side.
    const double spread = settings.bowl_radius_m > 0
                              ? 0.3 * settings.bowl_radius_m
                              : 0.7 * largest * std::sqrt(static_cast<double>(fruit.size()));
    DropWorld world(settings);
    SettledPile pile;
    std::size_t dropped = 0;
    double top_m = settings.bowl_radius_m > 0 ? settings.bowl_height_m : 0;
    std::vector<FruitPose> before;
    const double last_drop_s = static_cast<double>(fruit.size() - 1) * kBetweenDrops_s;
    for (int step = 0;; ++step) {
        run.throw_if_cancelled();
        pile.seconds = step * kStep_s;
        if (pile.seconds > kLongest_s)
            throw RunError("the pile does not come to rest: raise its friction or drop fewer fruit");
        if (dropped < fruit.size() && pile.seconds >= static_cast<double>(dropped) * kBetweenDrops_s) {
            for (std::size_t i = 0; i < dropped; ++i)
                top_m = std::max(top_m, world.pose(i).translation_m.z() + largest);
            const double around = 2 * std::numbers::pi * drop_random(settings.seed, dropped, 4);
            const double away = spread * std::sqrt(drop_random(settings.seed, dropped, 5));
            const Vec3 place(away * std::cos(around), away * std::sin(around), top_m + 1.1 * largest);
            world.drop(std::move(hulls[dropped]), fruit[dropped].mass_kg,
                       random_rotation(settings.seed, dropped), place);
            ++dropped;
        }
        world.step();
        world.calm(std::clamp((pile.seconds - last_drop_s) / kCalming_s, 0.0, 1.0));
        if (step % kStillSteps != 0 || dropped < fruit.size()) continue;
        if (before.size() == dropped && world.farthest_m(before) < kAtRest_m) break;
        before = world.poses();
    }
    pile.poses = world.poses();
    pile.contacts = world.contacts();
    return pile;
}

SurfaceFunction posed(const SurfaceFunction& surface, const FruitPose& pose) {
    return [surface, pose](const Vec3& direction) -> Vec3 {
        return pose.rotation * surface(direction) + pose.translation_m;
    };
}

InteriorFunction posed(const InteriorFunction& interior, const FruitPose& pose) {
    if (!interior) return {};
    return [interior, pose](const Vec3& direction, double fraction) -> Vec3 {
        return pose.rotation * interior(direction, fraction) + pose.translation_m;
    };
}

Ground ground_of(const PileSettings& settings) {
    return settings.bowl_radius_m > 0 ? bowl_ground(settings.bowl_radius_m, settings.bowl_height_m)
                                      : table_ground();
}

}  // namespace windfall::decay
