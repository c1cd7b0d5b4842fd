// An L-shaped plate at z = 0.5, with named boundary.
h = 0.6;
Point(1) = {0, 0, 0.5, h}; Point(2) = {2, 0, 0.5, h}; Point(3) = {2, 1, 0.5, h};
Point(4) = {1, 1, 0.5, h}; Point(5) = {1, 2, 0.5, h}; Point(6) = {0, 2, 0.5, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
Physical Curve("wall") = {1, 6};
Physical Surface("plate") = {1};
