function variables = load_mat(path)
  % LOAD_MAT  Results of the program as variables of MATLAB: of a storage file (.sto, .mot), of parameters.csv, or of
  % the folder of a run, as `myoid convert PATH FILE.mat` writes them.
  file = [tempname() '.mat'];
  tidy = onCleanup(@() delete_if_there(file));
  myoid.call('convert', {path, file}, 'quiet', true);
  variables = load(file);
end

function delete_if_there(file)
  if exist(file, 'file')
    delete(file);
  end
end
