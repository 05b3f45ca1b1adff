// Reads the written files back with HDF5 itself, as a viewer would.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/errors.hpp"
#include "output/particle_fields.hpp"
#include "output/structure_fields.hpp"
#include "temporary_folder.hpp"

namespace undex::output {
namespace {

struct Reader {
  hid_t file;
  explicit Reader(const std::filesystem::path& path) : file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {
    if (file < 0) throw std::runtime_error("cannot open " + path.string());
  }
  ~Reader() { H5Fclose(file); }
  bool has(const std::string& name) const { return H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0; }
  std::vector<hsize_t> shape(const std::string& name) const {
    const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<hsize_t> size(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, size.data(), nullptr);
    H5Sclose(space);
    H5Dclose(set);
    return size;
  }
  std::size_t stored_value_bytes(const std::string& name) const {
    const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT), type = H5Dget_type(set);
    const std::size_t bytes = H5Tget_size(type);
    H5Tclose(type);
    H5Dclose(set);
    return bytes;
  }
  std::vector<double> values(const std::string& name) const {
    const auto size = shape(name);
    std::vector<double> result(std::accumulate(size.begin(), size.end(), std::size_t{1}, std::multiplies<>()));
    const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.data());
    H5Dclose(set);
    return result;
  }
  double attribute(const std::string& object, const char* name) const {
    double value = -1;
    const hid_t attribute = H5Aopen_by_name(file, object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT);
    H5Aread(attribute, H5T_NATIVE_DOUBLE, &value);
    H5Aclose(attribute);
    return value;
  }
};

std::vector<Vec3> line_of_points(int n) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) points.emplace_back(i, 10 * i, -i);
  return points;
}

TEST(ParticleFields, ReadBackWithTimesVectorsAndIds) {
  const TemporaryFolder folder;
  ParticleFields out(folder.path / "particles.h5part");
  const auto points = line_of_points(3);
  const std::vector<double> pressure{1e5, 2e5, 1e300};
  const std::vector<Vec3> velocity{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  const std::vector<std::int64_t> ids{7, 8, 1'000'000'000'000};
  const std::vector<Field> fields{{"pressure", 1, pressure}, {"velocity", 3, as_components(velocity)}};
  out.write(0.0, points, fields, ids);
  out.write(1.5e-5, points, fields, ids);
  EXPECT_EQ(out.snapshots(), 2);

  const Reader in(folder.path / "particles.h5part");
  EXPECT_DOUBLE_EQ(in.attribute("Step#0", "TimeValue"), 0.0);
  EXPECT_DOUBLE_EQ(in.attribute("Step#1", "TimeValue"), 1.5e-5);
  EXPECT_FALSE(in.has("Step#2"));
  EXPECT_EQ(in.values("Step#1/x"), (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(in.values("Step#1/y"), (std::vector<double>{0, 10, 20}));
  EXPECT_EQ(in.values("Step#1/z"), (std::vector<double>{0, -1, -2}));
  EXPECT_EQ(in.values("Step#1/velocity_0"), (std::vector<double>{1, 4, 7}));
  EXPECT_EQ(in.values("Step#1/velocity_2"), (std::vector<double>{3, 6, 9}));
  EXPECT_EQ(in.values("Step#1/id"), (std::vector<double>{7, 8, 1e12}));
  EXPECT_EQ(in.stored_value_bytes("Step#1/pressure"), 4u);
  EXPECT_TRUE(std::isfinite(in.values("Step#1/pressure")[2])) << "beyond float32: the largest, not infinity";
  EXPECT_EQ(in.shape("Step#1/pressure"), (std::vector<hsize_t>{3}));
}

TEST(ParticleFields, ReadableAfterEverySnapshotAndWithChangingNumbers) {
  const TemporaryFolder folder;
  ParticleFields out(folder.path / "p.h5part");
  for (int n = 0; n < 4; ++n) {
    const int count = n == 0 ? 0 : 5000 * n;
    const auto points = line_of_points(count);
    const std::vector<double> density(points.size(), 1000.0 + n);
    const std::vector<Field> fields{{"density", 1, density}};
    out.write(n, points, fields);
    const Reader in(folder.path / "p.h5part");
    for (int m = 0; m <= n; ++m)
      EXPECT_EQ(in.shape("Step#" + std::to_string(m) + "/density")[0], m == 0 ? 0u : 5000u * static_cast<unsigned>(m));
  }
}

TEST(ParticleFields, WrongSizesAndNamesAreRefusedBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  ParticleFields out(folder.path / "p.h5part");
  const auto points = line_of_points(3);
  const std::vector<double> two(2), three(3);
  const auto refused = [&](const Field& field) {
    EXPECT_THROW(out.write(0, points, std::span<const Field>(&field, 1)), std::invalid_argument) << field.name;
  };
  refused({"pressure", 1, two});
  refused({"velocity", 3, three});
  refused({"stress_1", 1, three});
  refused({"a/b", 1, three});
  refused({"", 1, three});
  EXPECT_THROW(out.write(0, points, {}, std::vector<std::int64_t>(2)), std::invalid_argument);
  EXPECT_FALSE(Reader(folder.path / "p.h5part").has("Step#0"));
}

TEST(ParticleFields, KilledRunLeavesReadableSnapshots) {
  const TemporaryFolder folder;
  const auto path = folder.path / "p.h5part";
  for (int round = 0; round < 5; ++round) {
    int first[2];  // tells of the first snapshot: how long that takes is the machine's affair
    ASSERT_EQ(pipe(first), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ParticleFields out(path);
      const auto points = line_of_points(20000);
      const std::vector<double> pressure(points.size(), 1.0);
      const std::vector<Field> fields{{"pressure", 1, pressure}};
      for (int n = 0;; ++n) {
        out.write(n, points, fields);
        if (n == 0 && write(first[1], "1", 1) != 1) _exit(1);
      }
    }
    char told = 0;
    EXPECT_EQ(read(first[0], &told, 1), 1);
    close(first[0]);
    close(first[1]);
    usleep(100'000 + 7'000 * round);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const Reader in(path);
    int snapshots = 0;
    for (; in.has("Step#" + std::to_string(snapshots)); ++snapshots)
      ASSERT_EQ(in.values("Step#" + std::to_string(snapshots) + "/pressure").size(), 20000u);
    EXPECT_GT(snapshots, 0);
  }
}

TEST(ParticleFields, UnwritablePlaceAndForeignFileAreReported) {
  const TemporaryFolder folder;
  const auto missing = folder.path / "none" / "p.h5part";
  const std::string message = message_of<FileError>([&] { ParticleFields out(missing); });
  EXPECT_NE(message.find(missing.string()), std::string::npos) << message;
  EXPECT_NE(message.find("-o"), std::string::npos) << message;

  ParticleFields out(folder.path / "p.h5part");
  std::ofstream(folder.path / "p.h5part") << "not HDF5 any more";
  EXPECT_THROW(out.write(0, line_of_points(1), {}), FileError);
}

struct TwoCells {
  std::vector<Vec3> points;
  std::vector<std::array<int, 8>> cells{{0, 1, 2, 3, 4, 5, 6, 7}, {4, 5, 6, 7, 8, 9, 10, 11}};
  std::vector<double> strain{0.01, 0.02};
  TwoCells() {
    for (int z = 0; z < 3; ++z)
      for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) points.emplace_back(x, y, z);
  }
  StructureSnapshot snapshot() const {
    return {.positions = points,
            .cells = cells,
            .point_data = {{"displacement", 3, as_components(points)}},
            .cell_data = {{"plastic_strain", 1, strain}}};
  }
};

TEST(StructureFields, FileIsVtkhdfUnstructuredGrid) {
  const TemporaryFolder folder;
  const TwoCells mesh;
  StructureFields out(folder.path);
  out.write(2e-6, mesh.snapshot());

  const Reader in(folder.path / "structure_00000.hdf");
  const hid_t type = H5Aopen_by_name(in.file, "VTKHDF", "Type", H5P_DEFAULT, H5P_DEFAULT);
  const hid_t kind = H5Aget_type(type);
  EXPECT_EQ(H5Tis_variable_str(kind), 0) << "ParaView 5.11 reads fixed-length strings only";
  std::string text(H5Tget_size(kind), ' ');
  H5Aread(type, kind, text.data());
  EXPECT_EQ(text, "UnstructuredGrid");
  H5Tclose(kind);
  H5Aclose(type);
  std::int64_t version[2] = {-1, -1};
  const hid_t number = H5Aopen_by_name(in.file, "VTKHDF", "Version", H5P_DEFAULT, H5P_DEFAULT);
  H5Aread(number, H5T_NATIVE_INT64, version);
  H5Aclose(number);
  EXPECT_EQ(version[0], 1);
  EXPECT_EQ(version[1], 0);

  EXPECT_EQ(in.values("VTKHDF/NumberOfPoints"), std::vector<double>{12});
  EXPECT_EQ(in.values("VTKHDF/NumberOfCells"), std::vector<double>{2});
  EXPECT_EQ(in.values("VTKHDF/NumberOfConnectivityIds"), std::vector<double>{16});
  EXPECT_EQ(in.values("VTKHDF/Offsets"), (std::vector<double>{0, 8, 16}));
  EXPECT_EQ(in.values("VTKHDF/Types"), (std::vector<double>{12, 12}));
  EXPECT_EQ(in.values("VTKHDF/Connectivity")[8], 4);
  EXPECT_EQ(in.shape("VTKHDF/Points"), (std::vector<hsize_t>{12, 3}));
  EXPECT_EQ(in.shape("VTKHDF/PointData/displacement"), (std::vector<hsize_t>{12, 3}));
  EXPECT_EQ(in.shape("VTKHDF/CellData/plastic_strain"), (std::vector<hsize_t>{2}));
  EXPECT_NEAR(in.values("VTKHDF/CellData/plastic_strain")[1], 0.02, 1e-8);
  EXPECT_EQ(in.stored_value_bytes("VTKHDF/Points"), 4u);
}

TEST(StructureFields, MeridiansAreQuadrangles) {
  const TemporaryFolder folder;
  TwoCells mesh;
  mesh.cells = {{0, 1, 2, 3, 0, 1, 2, 3}, {4, 5, 6, 7, 4, 5, 6, 7}};
  StructureFields(folder.path).write(0.0, mesh.snapshot());
  const Reader in(folder.path / "structure_00000.hdf");
  EXPECT_EQ(in.values("VTKHDF/NumberOfConnectivityIds"), std::vector<double>{8});
  EXPECT_EQ(in.values("VTKHDF/Offsets"), (std::vector<double>{0, 4, 8}));
  EXPECT_EQ(in.values("VTKHDF/Types"), (std::vector<double>{9, 9}));
  EXPECT_EQ(in.values("VTKHDF/Connectivity"), (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7}));
}

/// Faces of surfaces: quadrangles, and in a plane segments.
TEST(StructureFields, FacesInAPlaneAreSegments) {
  const TemporaryFolder folder;
  TwoCells mesh;
  mesh.cells = {{0, 1, 1, 0, 0, 1, 1, 0}, {4, 5, 6, 7, 4, 5, 6, 7}};
  StructureFields(folder.path, "obstacles").write(0.0, mesh.snapshot());
  const Reader in(folder.path / "obstacles_00000.hdf");
  EXPECT_EQ(in.values("VTKHDF/Offsets"), (std::vector<double>{0, 2, 6}));
  EXPECT_EQ(in.values("VTKHDF/Types"), (std::vector<double>{3, 9}));
  EXPECT_EQ(in.values("VTKHDF/Connectivity"), (std::vector<double>{0, 1, 4, 5, 6, 7}));
}

TEST(StructureFields, IndexListsEverySnapshotWithItsTime) {
  const TemporaryFolder folder;
  const TwoCells mesh;
  StructureFields out(folder.path);
  for (int n = 0; n < 3; ++n) {
    out.write(1e-6 * n, mesh.snapshot());
    const auto index = nlohmann::json::parse(read_text(folder.path / "structure.hdf.series"));
    EXPECT_EQ(index["file-series-version"], "1.0");
    ASSERT_EQ(index["files"].size(), static_cast<std::size_t>(n) + 1);
    EXPECT_EQ(index["files"][n]["name"], "structure_0000" + std::to_string(n) + ".hdf");
    EXPECT_DOUBLE_EQ(index["files"][n]["time"], 1e-6 * n);
  }
  EXPECT_EQ(folder.files(), 4u) << "no temporary file may be left";
}

TEST(StructureFields, BadMeshesAndFieldsAreRefused) {
  const TemporaryFolder folder;
  TwoCells mesh;
  StructureFields out(folder.path);
  mesh.cells[1][3] = 99;
  EXPECT_THROW(out.write(0, mesh.snapshot()), std::invalid_argument);
  mesh.cells[1][3] = 7;
  mesh.strain.pop_back();
  EXPECT_THROW(out.write(0, mesh.snapshot()), std::invalid_argument);
  EXPECT_EQ(folder.files(), 0u);
  EXPECT_THROW(StructureFields(folder.path / "none").write(0, TwoCells().snapshot()), FileError);
}

}  // namespace
}  // namespace undex::output
