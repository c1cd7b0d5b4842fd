SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 0.5};
Physical Surface("floor") = {5};
Physical Volume("brick") = {1};
Mesh.MeshSizeMin = 0.5; Mesh.MeshSizeMax = 0.5;
