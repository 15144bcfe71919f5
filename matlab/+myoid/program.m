function name = program()
  % PROGRAM  The program that the functions of this package call: the environment variable MYOID, else myoid of the path.
  name = getenv('MYOID');
  if isempty(name)
    name = 'myoid';
  end
end
