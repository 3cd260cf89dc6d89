namespace gearpod {}
