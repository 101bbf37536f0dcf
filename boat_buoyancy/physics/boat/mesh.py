def read_mesh(path, scale=1.0):
    raise NotImplementedError
