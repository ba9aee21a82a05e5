#include "sim/world_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "sim/mesh_file.hpp"

namespace pilothouse::sim {
namespace {

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A folder of its own with a world in it.
class WorldFile : public ::testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/world_file_XXXXXX";
    ASSERT_NE(mkdtemp(name), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    for (const std::string& file : files_) unlink(file.c_str());
    rmdir(folder_.c_str());
  }
  std::string write(const std::string& name, const std::string& bytes) {
    const std::string path = folder_ + "/" + name;
    std::ofstream(path, std::ios::binary) << bytes;
    files_.push_back(path);
    return path;
  }
  /// Lines 1 to 3 are given; `body` begins at line 4.
  Checked<LoadedWorld> load(const std::string& body) {
    return loadWorld(write("pose.sdf",  // called like one of SDF's own elements, on purpose
                           "<?xml version=\"1.0\"?>\n"
                           "<sdf version=\"1.9\" xmlns:pilothouse=\"https://pilothouse.invalid\">\n"
                           "<world name=\"w\">\n" +
                               body + "\n</world>\n</sdf>\n"));
  }
  /// A model whose one visual has this geometry, and whatever else stands in the visual. The
  /// geometry is on line 7.
  static std::string model(const std::string& geometry, const std::string& more = "") {
    return "<model name=\"m\"><pose>1 2 3 0 0 0</pose>\n<link name=\"l\">\n<visual name=\"v\">" +
           more + "\n<geometry>" + geometry + "</geometry>\n</visual>\n</link></model>";
  }
  static std::string actor(const std::string& waypoints) {
    return "<actor name=\"a\">\n<pilothouse:courtesy>0.5</pilothouse:courtesy>\n<script>"
           "<loop>true</loop><trajectory id=\"0\" type=\"walk\">\n" +
           waypoints + "</trajectory></script></actor>";
  }
  std::string folder_;
  std::vector<std::string> files_;
};

Eigen::AlignedBox3d boundsOf(const Model& model) {
  Eigen::AlignedBox3d box;
  for (const Part& part : model.parts)
    for (const auto& vertex : part.mesh.vertices)
      box.extend(model.T_world_model * vertex.cast<double>());
  return box;
}

TEST_F(WorldFile, ReadsShapesWhereTheyStand) {
  const struct {
    const char* geometry;
    Eigen::Vector3d half;
  } shapes[] = {{"<box><size>0.2 0.4 0.6</size></box>", {0.1, 0.2, 0.3}},
                {"<cylinder><radius>0.3</radius><length>1</length></cylinder>", {0.3, 0.3, 0.5}},
                {"<sphere><radius>0.25</radius></sphere>", {0.25, 0.25, 0.25}},
                {"<plane><normal>0 0 1</normal><size>4 2</size></plane>", {2.0, 1.0, 0.0}}};
  for (const auto& shape : shapes) {
    const auto loaded = load(model(shape.geometry));
    ASSERT_TRUE(loaded) << loaded.reason();
    ASSERT_EQ(loaded->world.models.size(), 1U);
    const auto box = boundsOf(loaded->world.models[0]);
    EXPECT_LT((box.center() - Eigen::Vector3d(1, 2, 3)).norm(), 0.01) << shape.geometry;
    EXPECT_LT((box.sizes() / 2.0 - shape.half).cwiseAbs().maxCoeff(), 0.02) << shape.geometry;
  }
}

TEST_F(WorldFile, ReadsStartRoutesSunlightAndPeople) {
  const auto loaded = load(
      "<pilothouse:start>1 2 0.5</pilothouse:start>\n"
      "<pilothouse:route name=\"tour\"><pilothouse:point>1 2</pilothouse:point>"
      "<pilothouse:point>3 4</pilothouse:point></pilothouse:route>\n"
      "<pilothouse:sunlight><pilothouse:low>0 0 0</pilothouse:low>"
      "<pilothouse:high>1 2 3</pilothouse:high></pilothouse:sunlight>\n" +
      actor("<waypoint><time>0</time><pose>1 0 0 0 0 0</pose></waypoint>"
            "<waypoint><time>4</time><pose>5 0 0 0 0 1.5</pose></waypoint>"));
  ASSERT_TRUE(loaded) << loaded.reason();
  const World& world = loaded->world;
  EXPECT_EQ(world.start.heading, 0.5);
  ASSERT_EQ(world.routes.count("tour"), 1U);
  EXPECT_EQ(world.routes.at("tour")[1], Eigen::Vector2d(3, 4));
  ASSERT_EQ(world.sunlight.size(), 1U);
  EXPECT_EQ(world.sunlight[0].max().z(), 3.0);
  ASSERT_EQ(world.models.size(), 1U);
  EXPECT_EQ(world.models[0].courtesy, 0.5);
  ASSERT_TRUE(world.models[0].path);
  ASSERT_EQ(world.models[0].path->points.size(), 2U);
  EXPECT_EQ(world.models[0].path->points[1].time, 4.0);
  EXPECT_NEAR(world.models[0].path->points[1].pose.heading, 1.5, 1e-9);
  EXPECT_NEAR(boundsOf(world.models[0]).sizes().z(), 1.75, 0.05);
}

TEST_F(WorldFile, ReadsLooks) {
  const auto loaded = load(model("<box><size>1 1 1</size></box>",
                                 "<transparency>0.7</transparency><material>"
                                 "<diffuse>0.1 0.2 0.3 1</diffuse>"
                                 "<pilothouse:texture>wood</pilothouse:texture></material>"));
  ASSERT_TRUE(loaded) << loaded.reason();
  const Material& material = loaded->world.models[0].parts[0].material;
  EXPECT_TRUE(material.glass);
  EXPECT_NEAR(material.colour.z(), 0.3F, 1e-6F);
  ASSERT_EQ(material.texture, 0);
  EXPECT_EQ(loaded->world.textures.size(), 1U);
}

TEST_F(WorldFile, CollisionsSayWhatIsSolidAndWithoutThemVisualsDo) {
  const std::string box = "<geometry><box><size>1 1 1</size></box></geometry>";
  const auto both = load("<model name=\"m\"><link name=\"l\"><visual name=\"v\">" + box +
                         "</visual><collision name=\"c\">" + box + "</collision></link></model>");
  ASSERT_TRUE(both) << both.reason();
  ASSERT_EQ(both->world.models[0].parts.size(), 2U);
  EXPECT_FALSE(both->world.models[0].parts[0].solid);
  EXPECT_TRUE(both->world.models[0].parts[1].solid);
  EXPECT_FALSE(both->world.models[0].parts[1].visible);
  const auto visual = load(model("<box><size>1 1 1</size></box>"));
  EXPECT_TRUE(visual->world.models[0].parts[0].solid);
}

TEST_F(WorldFile, ReadsMeshesWithTheirScale) {
  write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto loaded = load(model("<mesh><uri>m.obj</uri><scale>2 3 1</scale></mesh>"));
  ASSERT_TRUE(loaded) << loaded.reason();
  const auto box = boundsOf(loaded->world.models[0]);
  EXPECT_LT((box.sizes() - Eigen::Vector3d(2, 3, 0)).norm(), 1e-5);
}

TEST_F(WorldFile, WarnsOfWhatItDoesNotSimulate) {
  const auto loaded = load("<plugin name=\"p\" filename=\"x.so\"/>\n<unheard>1</unheard>\n" +
                           model("<box><size>1 1 1</size></box>"));
  ASSERT_TRUE(loaded) << loaded.reason();
  ASSERT_EQ(loaded->warnings.size(), 2U);
  EXPECT_PRED2(holds, loaded->warnings[0], "line 4: <plugin> \"p\" is not simulated");
  EXPECT_PRED2(holds, loaded->warnings[1], "line 5: XML Element[unheard]");
}

TEST_F(WorldFile, RefusesBadFilesNamingLineAndElement) {
  const std::string box = "<box><size>1 1 1</size></box>";
  const std::string at = "<waypoint><time>0</time><pose>0 0 0 0 0 0</pose></waypoint>";
  const struct {
    std::string body;
    const char *line, *says;
  } faults[] = {
      {model("<box><size>1 nan 3</size></box>"), "line 7: <size>", "1 nan 3"},
      {model("<box><size>1 -2 3</size></box>"), "line 7: <size>", "three lengths"},
      {model("<box><size>1 2</size></box>"), "line 7: <size>", "three lengths"},
      {model("<box><size>1 1e400 2</size></box>"), "line 7: <size>", "three lengths"},
      {model("<box><size>1 2 3 4</size></box>"), "line 7: <size>", "three lengths"},
      {model("<box><size>0x10 2 3</size></box>"), "line 7: <size>", "three lengths"},
      {model("<box></box>"), "line 7: <box>", "no <size>"},
      {model("<bax><size>1 2 3</size></bax>"), "line 7: <bax>", "no known shape"},
      {model(""), "line 7: <geometry>", "empty"},
      {model(box + box), "line 7: <geometry>", "more than one"},
      {model("<cylinder><radius>0</radius><length>1</length></cylinder>"), "line 7: <radius>",
       "one length"},
      {model("<cylinder><radius>1</radius></cylinder>"), "line 7: <cylinder>", "no <length>"},
      {model("<sphere><radius>inf</radius></sphere>"), "line 7: <radius>", "one length"},
      {model("<plane><normal>0 0 0</normal><size>1 1</size></plane>"), "line 7: <normal>",
       "a direction"},
      {model("<mesh><uri>none.obj</uri></mesh>"), "line 7: ", "No such file"},
      {model("<mesh><uri>model://sofa/sofa.obj</uri></mesh>"), "line 7: ", "beside the world"},
      {model("<mesh><uri>../../etc/passwd</uri></mesh>"), "line 7: ", "or below it"},
      {model("<mesh><uri>/etc/passwd</uri></mesh>"), "line 7: ", "or below it"},
      {model(box, "<pose>1 2 x 0 0 0</pose>"), "line 6: <pose>", "six numbers"},
      {model(box, "<pose>1 2</pose>"), "line 6: <pose>", "six numbers"},
      {model(box, "<pose>1e9 0 0 0 0 0</pose>"), "line 6: <pose>", "six numbers"},
      {model(box, "<transparency>7</transparency>"), "line 6: <transparency>", "0 to 1"},
      {model(box, "<material><diffuse>1 2 3 4</diffuse></material>"), "line 6: <diffuse>",
       "0 to 1"},
      {model(box, "<material><pilothouse:texture>gold</pilothouse:texture></material>"),
       "line 6: <pilothouse:texture>", "expected one of asphalt"},
      {model(box, "<material><pbr><metal><albedo_map>no.png</albedo_map></metal></pbr></material>"),
       "line 6: <visual>", "no.png"},
      {model(box) + "\n" + model(box), "line 10: <model> \"m\"", "another model"},
      {"<model><link name=\"l\"/></model>", "line 4: <model>", "no name"},
      {"<model name=\"m\"><link name=\"l\"/></model>", "line 4: <model>", "nothing to see"},
      {"<model name=\"m\"><link name=\"l\"><visual name=\"v\"/></link></model>",
       "line 4: <visual> \"v\"", "no <geometry>"},
      {"<model name=\"m\"/>", "line 4: <model> \"m\"", "no <link>"},
      {"<model name=\"m\"><link name=\"l\"/><model name=\"n\"/></model>", "line 4: <model> \"n\"",
       "within another"},
      {"<include><uri>model://x</uri></include>", "line 4: <include>", "not read"},
      {actor(""), "line 6: <trajectory>", "no <waypoint>"},
      {actor(at + "\n" + at), "line 8: <time>", "later than the one before"},
      {actor("<waypoint><time>0</time></waypoint>"), "line 7: <waypoint>", "no <pose>"},
      {actor("<waypoint><time>nan</time><pose>0 0 0 0 0 0</pose></waypoint>"), "line 7: <time>",
       "seconds"},
      {"<actor name=\"a\"/>", "line 4: <actor> \"a\"", "no <script>"},
      {"<pilothouse:start>1 2</pilothouse:start>", "line 4: <pilothouse:start>", "x y heading"},
      {"<pilothouse:route name=\"r\"/>", "line 4: <pilothouse:route> \"r\"",
       "no <pilothouse:point>"},
      {"<pilothouse:route><pilothouse:point>1 2</pilothouse:point></pilothouse:route>",
       "line 4: <pilothouse:route>", "no name"},
      {"<pilothouse:route name=\"r\"><pilothouse:point>1 b</pilothouse:point></pilothouse:route>",
       "line 4: <pilothouse:point>", "two numbers"},
      {"<pilothouse:sunlight><pilothouse:low>1 1 1</pilothouse:low>"
       "<pilothouse:high>0 0 0</pilothouse:high></pilothouse:sunlight>",
       "line 4: <pilothouse:sunlight>", "empty"},
      {"<pilothouse:sunshine/>", "line 4: <pilothouse:sunshine>", "unknown"},
      {"<model name=\"m\">", "line ", "not well-formed"}};
  for (const auto& fault : faults) {
    const auto loaded = load(fault.body);
    ASSERT_FALSE(loaded) << fault.body;
    EXPECT_PRED2(holds, loaded.reason(), "pose.sdf: line") << fault.body;
    EXPECT_PRED2(holds, loaded.reason(), fault.line) << fault.body;
    EXPECT_PRED2(holds, loaded.reason(), fault.says) << fault.body;
  }
}

TEST_F(WorldFile, RefusesWhatIsNoWorld) {
  EXPECT_PRED2(holds, loadWorld(folder_ + "/none.sdf").reason(), "No such file");
  EXPECT_PRED2(holds, loadWorld(folder_).reason(), "not a file");
  const struct {
    std::string bytes;
    const char* says;
  } faults[] = {{"", "not well-formed"},
                {std::string("\0\1\2garbage", 10), "not well-formed"},
                {"<robot/>", "expected <sdf>"},
                {"<sdf/>", "no version"},
                {"<sdf version=\"9.9\"><world name=\"w\"/></sdf>", "expected 1.4 to 1.9"},
                {"<sdf version=\"1.9\"/>", "no <world>"},
                {"<sdf version=\"1.9\"><world name=\"a\"/><world name=\"b\"/></sdf>", "one world"},
                {std::string(70, '<'), "not well-formed"}};
  for (const auto& fault : faults)
    EXPECT_PRED2(holds, loadWorld(write("w.sdf", fault.bytes)).reason(), fault.says);
  std::string deep = "<sdf version=\"1.9\"><world name=\"w\">";
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_PRED2(holds, loadWorld(write("deep.sdf", deep)).reason(), "not well-formed");
}

TEST_F(WorldFile, RefusesMoreTrianglesThanItTakes) {
  const auto faces = [](int count) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < count; ++i) text += "f 1 2 3\n";
    return text;
  };
  const std::string mesh = "<mesh><uri>m.obj</uri></mesh>";
  write("m.obj", faces(100001));
  EXPECT_PRED2(holds, load(model(mesh)).reason(), "line 100004: more than 100000 triangles");
  write("m.obj", faces(60000));
  EXPECT_TRUE(load(model(mesh)));
  std::string second = model(mesh);
  second.replace(second.find("\"m\""), 3, "\"n\"");
  EXPECT_PRED2(holds, load(model(mesh) + second).reason(), "more than 100000 triangles");
}

TEST(MeshFile, ReadsObj) {
  const auto mesh = parseObj(
      "# square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\n"
      "usemtl x\nf 1/1/1 2/2/1 3/2/1 -1/1/1\n");
  ASSERT_TRUE(mesh) << mesh.reason();
  EXPECT_EQ(mesh->triangles.size(), 2U);
  EXPECT_EQ(mesh->vertices.size(), 4U);
  EXPECT_EQ(mesh->texture_coordinates.size(), 4U);
}

TEST(MeshFile, RefusesBadObjNamingTheLine) {
  for (const char* text : {"v 0 0\nf 1 1 1\n", "v 0 0 nan\n", "v 1e9 0 0\n", "v 0 0 0\nf 1 2 3\n",
                           "v 0 0 0\nf 1 1\n", "v 0 0 0\nf 0 1 1\n", "v 0 0 0\nf 1/1 1 1\n",
                           "v 0 0 0\nf 1.5 1 1\n", "v 0 0 0\nf -2 1 1\n"}) {
    EXPECT_PRED2(holds, parseObj(text).reason(), "line ") << text;
  }
  EXPECT_EQ(parseObj("").reason(), "no faces");
}

std::string binaryStl(std::uint32_t said, std::uint32_t triangles, float value) {
  std::string bytes(80, 's');
  bytes.append(reinterpret_cast<const char*>(&said), 4);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    for (int k = 0; k < 12; ++k) {
      const float number = value + static_cast<float>(k % 4);
      bytes.append(reinterpret_cast<const char*>(&number), 4);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST(MeshFile, ReadsStlOfBothKinds) {
  const auto binary = parseStl(binaryStl(2, 2, 0.5F));
  ASSERT_TRUE(binary) << binary.reason();
  EXPECT_EQ(binary->triangles.size(), 2U);
  EXPECT_EQ(binary->vertices.size(), 3U);  // the same twice, joined
  const auto ascii = parseStl(
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
      "endloop\nendfacet\nendsolid\n");
  ASSERT_TRUE(ascii) << ascii.reason();
  EXPECT_EQ(ascii->triangles.size(), 1U);
}

TEST(MeshFile, RefusesBadStl) {
  EXPECT_FALSE(parseStl(""));
  EXPECT_FALSE(parseStl(binaryStl(3, 2, 0.5F)));
  EXPECT_FALSE(parseStl(binaryStl(0xFFFFFFFFU, 2, 0.5F)));
  EXPECT_FALSE(parseStl(binaryStl(2, 2, std::nanf(""))));
  EXPECT_FALSE(parseStl(binaryStl(0, 0, 0.0F)));
  EXPECT_FALSE(parseStl("solid a\nfacet\nvertex 0 0 0\nendfacet\n"));
  EXPECT_FALSE(parseStl("solid a\nfacet\nvertex 0 0 x\n"));
}

}  // namespace
}  // namespace pilothouse::sim
